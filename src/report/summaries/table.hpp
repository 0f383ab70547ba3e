// A table of text: columns as wide as their widest entry.
#pragma once

#include <string>
#include <vector>

namespace rockfold {

struct Column {
  std::string head;
  std::string unit;   ///< second line of the head, may be empty
  bool left = false;  ///< texts to the left, numbers to the right
};

/// Each row has one entry a column. Every line is indented by two and ends without blanks.
std::string table_text(const std::vector<Column>& columns,
                       const std::vector<std::vector<std::string>>& rows);

/// With so many decimals; two digits of what is not zero and would be written as such.
std::string fixed_text(double x, int decimals);

}  // namespace rockfold
