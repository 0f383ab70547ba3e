#include "src/page/write_page.hpp"

#include <filesystem>
#include <fstream>

#include "src/base/error.hpp"
#include "src/io/hdf5/deflate.hpp"
#include "src/io/partial_file.hpp"
#include "src/page/page_bundle.hpp"
#include "src/page/page_content.hpp"

namespace rockfold {

namespace {

/// Where the page's data go, in the text that src/web builds.
constexpr std::string_view data_mark = "<!--data-->";

}  // namespace

bool has_page() {
  return page_bundle().size > 0;
}

PageFacts write_page(const std::string& result, const std::string& page, const PageChoice& choice) {
  const PageBundle bundle = page_bundle();
  if (bundle.size == 0)
    throw Error(ErrorKind::usage,
                "this program was built without npm, so it has no page; install npm, build again");
  PageContent content = read_page_content(result, choice);
  const std::string text = gunzipped(bundle.gzip, bundle.size);
  const std::size_t mark = text.find(data_mark);
  PartialFile target(page);
  std::ofstream out(target.aside(), std::ios::binary);
  out << std::string_view(text).substr(0, mark);
  put_page_content(out, content);
  out << std::string_view(text).substr(mark + data_mark.size());
  out.close();
  if (!out) throw Error(ErrorKind::io, "cannot be written", Place{page, 0, 0, {}});
  content.facts.bytes = static_cast<std::int64_t>(std::filesystem::file_size(target.aside()));
  target.take_name();
  return content.facts;
}

}  // namespace rockfold
