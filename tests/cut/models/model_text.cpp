#include "tests/cut/models/model_text.hpp"

#include <charconv>

namespace rockfold::test {

namespace {

std::string text(Real x) {
  char buffer[40];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr};
}
std::string text(int x) {
  return std::to_string(x);
}
template <class T, std::size_t n>
std::string text(const std::array<T, n>& list) {
  std::string all = "[";
  for (const T& x : list) all += (all.size() > 1 ? ", " : "") + text(x);
  return all + "]";
}
template <class T>
std::string text(const std::vector<T>& list) {
  std::string all = "[";
  for (const T& x : list) all += (all.size() > 1 ? ", " : "") + text(x);
  return all + "]";
}

class Writer {
 public:
  template <class T>
  void key(const char* name, const T& value) {
    out += std::string(name) + " = " + text(value) + "\n";
  }
  void string(const char* name, const std::string& value) {
    out += std::string(name) + " = \"" + value + "\"\n";
  }
  void surface(const char* name, const char* extension) {
    string(name, "surface" + std::to_string(surfaces_++) + extension);
  }

  void orientation(const Orientation& o) {
    if (const auto* normal = std::get_if<Vec3>(&o)) return key("normal", *normal);
    const auto& angles = std::get<DipOrientation>(o);
    key("dip", angles.dip);
    key("dip_direction", angles.dip_direction);
  }

  void operator()(const BoxShape& s) {
    string("shape", "box");
    key("min", s.min);
    key("max", s.max);
  }
  void operator()(const HalfspacesShape& s) {
    string("shape", "halfspaces");
    out += "planes = [\n";
    for (const HalfSpace& h : s.planes) {
      out += "  {";
      if (const auto* normal = std::get_if<Vec3>(&h.plane.orientation)) {
        out += "normal = " + text(*normal);
      } else {
        const auto& angles = std::get<DipOrientation>(h.plane.orientation);
        out += "dip = " + text(angles.dip) + ", dip_direction = " + text(angles.dip_direction);
      }
      out += ", point = " + text(h.plane.point) + ", keep = \"" +
             (h.keep_above ? "above" : "below") + "\"},\n";
    }
    out += "]\n";
  }
  void operator()(const PrismShape& s) {
    string("shape", "prism");
    key("base", s.base);
    key("extrude", s.extrude);
  }
  void operator()(const CylinderShape& s) {
    string("shape", "cylinder");
    key("axis", s.axis);
    key("radius", s.radius);
    key("sides", s.sides);
  }
  void operator()(const TunnelShape& s) {
    string("shape", "tunnel");
    key("path", s.path);
    key("section", s.section);
  }
  void operator()(const MeshShape&) {
    string("shape", "mesh");
    surface("file", ".obj");
  }
  void operator()(const TerrainShape& s) {
    string("shape", "terrain");
    surface("file", ".xyz");
    key("base", s.base);
  }
  template <class Other>
  void operator()(const Other&) {
    out += "# a shape that is not written\n";
  }

  std::string out;

 private:
  int surfaces_ = 0;
};

}  // namespace

std::string to_toml(const Model& model) {
  Writer w;
  w.out = "[[joint_material]]\nfriction_angle = 30\n";
  for (const Solid& s : model.solids) {
    w.out += "[[solid]]\n";
    w.string("name", s.name);
    if (!s.add) w.string("operation", "subtract");
    std::visit(w, s.shape);
  }
  for (const Excavation& e : model.excavations) {
    w.out += "[[excavation]]\n";
    w.string("name", e.name);
    w.key("stage", e.stage);
    std::visit(w, e.shape);
  }
  for (const JointSet& s : model.joint_sets) {
    w.out += "[[joint_set]]\n";
    w.string("name", s.name);
    w.orientation(s.orientation);
    w.key("spacing", s.spacing);
    w.key("origin", s.origin);
    if (s.count) w.key("count", *s.count);
    if (s.radius) w.key("radius", *s.radius);
  }
  for (const Joint& j : model.joints) {
    w.out += "[[joint]]\n";
    w.string("name", j.name);
    w.orientation(j.plane.orientation);
    w.key("point", j.plane.point);
    if (j.radius) w.key("radius", *j.radius);
    if (!j.polygon.empty()) w.key("polygon", j.polygon);
  }
  for (const JointMesh& m : model.joint_meshes) {
    w.out += "[[joint_mesh]]\n";
    w.string("name", m.name);
    w.surface("file", ".obj");
  }
  return w.out;
}

std::string surface_text(const TriangleSurface& surface) {
  std::string all;
  for (const Vec3& x : surface.vertices)
    all += "v " + text(x[0]) + " " + text(x[1]) + " " + text(x[2]) + "\n";
  for (const auto& t : surface.triangles)
    all += "f " + text(t[0] + 1) + " " + text(t[1] + 1) + " " + text(t[2] + 1) + "\n";
  return all;
}

}  // namespace rockfold::test
