#include "src/printed/printed_report.hpp"

#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/io/hdf5/deflate.hpp"
#include "src/io/partial_file.hpp"
#include "src/page/page_bundle.hpp"
#include "src/page/page_content.hpp"
#include "src/printed/print_style.hpp"
#include "src/printed/report_source.hpp"

namespace rockfold {

namespace {

/// Nothing is fetched, and nothing but the program's own script is run.
constexpr const char* head =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
    "'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\">\n";

/// What the views draw: the first and the last state. Nothing, with the reason in `why_not`, where there can be none.
std::optional<PageContent> view_content(const std::string& result, std::string& why_not) {
  if (views_bundle().size == 0) {
    why_not = "There are no views: this program was built without npm.";
    return {};
  }
  try {
    return read_page_content(result, {.every = std::numeric_limits<Index>::max()});
  } catch (const Error& error) {
    why_not = fmt::format("There are no views: {}.", error.what());
    return {};
  }
}

void add_views(Html& html, const std::string& why_not) {
  html.raw("<section id=\"views\">\n");
  html.heading(2, "Views");
  html.raw(fmt::format("<p class=\"note\" id=\"views-note\">{}</p>\n</section>\n",
                       why_not.empty()
                           ? "A browser that runs scripts and has WebGL 2 draws them here."
                           : html_escaped(why_not)));
}

std::string body_of(const ReportSource& source, const std::string& why_no_views) {
  Html html;
  html.heading(1, source.title.empty() ? source.file : source.title);
  add_summary(html, source);
  add_model(html, source);
  add_joints(html, source);
  add_views(html, why_no_views);
  add_block_sizes(html, source);
  add_keyblocks(html, source);
  add_support_design(html, source);
  add_classification(html, source);
  add_analysis(html, source);
  add_assumptions(html, source);
  add_warnings(html, source);
  add_model_text(html, source);
  return html.text();
}

}  // namespace

PrintedFacts write_report(const std::string& result, const std::string& report) {
  const ReportSource source = read_report_source(result);
  std::string why_not, body;
  const auto views = view_content(result, why_not);
  try {
    body = body_of(source, why_not);
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::io, fmt::format("is damaged ({})", error.what()),
                Place{result, 0, 0, {}});
  }
  PartialFile target(report);
  std::ofstream out(target.aside(), std::ios::binary);
  out << head << "<title>" << html_escaped(source.title.empty() ? source.file : source.title)
      << " – report</title>\n<style>" << print_style << "</style>\n</head>\n<body>\n"
      << body;
  if (views) {
    put_page_content(out, *views);
    out << "<script>" << gunzipped(views_bundle().gzip, views_bundle().size) << "</script>\n";
  }
  out << "</body>\n</html>\n";
  out.close();
  if (!out) throw Error(ErrorKind::io, "cannot be written", Place{report, 0, 0, {}});
  const PrintedFacts facts{static_cast<std::int64_t>(std::filesystem::file_size(target.aside())),
                           views.has_value()};
  target.take_name();
  return facts;
}

}  // namespace rockfold
