// HTML of a printed report. Every text goes through `escaped`: names and titles come from models and are data, whatever they say.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rockfold {

std::string html_escaped(std::string_view text);

struct HtmlColumn {
  std::string head;
  std::string unit = {};  ///< below the head
  bool left = false;      ///< texts stand to the left, numbers to the right
};

class Html {
 public:
  void heading(int level, const std::string& words, const std::string& id = {});
  void paragraph(const std::string& words, const std::string& css_class = {});
  void list(const std::vector<std::string>& items);
  /// Names and values, two columns.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  /// Each row has one text a column; heads come again on every printed page.
  void table(const std::string& caption, const std::vector<HtmlColumn>& columns,
             const std::vector<std::vector<std::string>>& rows);
  /// A drawing with a caption, never parted by a page's end.
  void figure(const std::string& svg, const std::string& caption);
  void preformatted(const std::string& text);
  /// Markup of the program's own.
  void raw(const std::string& markup) { text_ += markup; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace rockfold
