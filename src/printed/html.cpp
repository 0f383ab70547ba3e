#include "src/printed/html.hpp"

#include <fmt/format.h>

namespace rockfold {

namespace {
constexpr std::size_t most_columns_of_usual_size = 9;
}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      out += ' ';
    else
      out += c;
  }
  return out;
}

void Html::heading(int level, const std::string& words, const std::string& id) {
  text_ += id.empty()
               ? fmt::format("<h{0}>{1}</h{0}>\n", level, html_escaped(words))
               : fmt::format("<h{0} id=\"{2}\">{1}</h{0}>\n", level, html_escaped(words), id);
}

void Html::paragraph(const std::string& words, const std::string& css_class) {
  text_ += css_class.empty()
               ? fmt::format("<p>{}</p>\n", html_escaped(words))
               : fmt::format("<p class=\"{}\">{}</p>\n", css_class, html_escaped(words));
}

void Html::list(const std::vector<std::string>& items) {
  text_ += "<ul>\n";
  for (const std::string& item : items) text_ += "<li>" + html_escaped(item) + "</li>\n";
  text_ += "</ul>\n";
}

void Html::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  text_ += "<table class=\"facts\"><tbody>\n";
  for (const auto& [name, value] : facts)
    text_ += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escaped(name),
                         html_escaped(value));
  text_ += "</tbody></table>\n";
}

void Html::table(const std::string& caption, const std::vector<HtmlColumn>& columns,
                 const std::vector<std::vector<std::string>>& rows) {
  const auto side = [&](std::size_t c) { return columns[c].left ? " class=\"left\"" : ""; };
  text_ += columns.size() > most_columns_of_usual_size ? "<table class=\"wide\">\n" : "<table>\n";
  if (!caption.empty()) text_ += "<caption>" + html_escaped(caption) + "</caption>\n";
  text_ += "<thead><tr>";
  for (std::size_t c = 0; c < columns.size(); ++c)
    text_ += fmt::format(
        "<th scope=\"col\"{}>{}{}</th>", side(c), html_escaped(columns[c].head),
        columns[c].unit.empty() ? "" : "<br><small>" + html_escaped(columns[c].unit) + "</small>");
  text_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    text_ += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c)
      text_ += fmt::format("<td{}>{}</td>", side(c), html_escaped(row[c]));
    text_ += "</tr>\n";
  }
  text_ += "</tbody></table>\n";
}

void Html::figure(const std::string& svg, const std::string& caption) {
  text_ += "<figure>\n" + svg + "<figcaption>" + html_escaped(caption) + "</figcaption></figure>\n";
}

void Html::preformatted(const std::string& text) {
  text_ += "<pre>" + html_escaped(text) + "</pre>\n";
}

}  // namespace rockfold
