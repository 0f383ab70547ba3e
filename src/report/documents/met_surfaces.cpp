#include "src/report/documents/met_surfaces.hpp"

#include <fmt/format.h>

#include "src/report/documents/document_parts.hpp"
#include "src/run/contact_setup.hpp"

namespace rockfold {
namespace {

const char* by_name(MetSurfaces::By by) {
  using By = MetSurfaces::By;
  switch (by) {
    case By::own:
      return "own";
    case By::pair:
      return "contact_pair";
    case By::weaker:
      return "weaker";
    case By::given:
      return "contact.material";
    case By::guess:
      return "first";
  }
  return "";
}

std::string reason(const std::string& by) {
  if (by == "weaker") return "the weaker of the two";
  if (by == "first") return "the first joint material, as contact.material names none";
  return by == "own" ? "" : by;
}

}  // namespace

Json met_json(const Model& model, const std::vector<MetSurfaces>& met) {
  Json list = Json::array();
  for (const MetSurfaces& m : met)
    list.push_back(
        {{"between", {surface_name(model, m.between[0]), surface_name(model, m.between[1])}},
         {"material", m.material == none ? Json() : Json(model.joint_materials[m.material].name)},
         {"by", by_name(m.by)}});
  return list;
}

std::string met_text(const Json& met) {
  const auto& between = met.at("between");
  const std::string one = between.at(0), other = between.at(1), by = met.at("by");
  const std::string surfaces = one == other ? one : one + " on " + other;
  const Json& material = met.at("material");
  const std::string why = reason(by);
  return fmt::format("{}: {}{}", surfaces,
                     material.is_null() ? "smooth" : material.get<std::string>(),
                     why.empty() ? "" : " (" + why + ")");
}

}  // namespace rockfold
