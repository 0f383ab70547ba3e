// What a page holds of a result: a JSON document and arrays, and how they stand in HTML.
#pragma once

#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "src/page/page_arrays.hpp"
#include "src/page/write_page.hpp"

namespace rockfold {

struct PageContent {
  nlohmann::ordered_json document;
  PageArrays arrays;
  PageFacts facts;
};

/// Throws Error(io) as write_page does.
PageContent read_page_content(const std::string& path, const PageChoice& choice);

/// As elements that the page's script finds by their ids.
void put_page_content(std::ostream& out, const PageContent& content);

}  // namespace rockfold
