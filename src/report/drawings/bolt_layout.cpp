#include "src/report/drawings/bolt_layout.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "host/bolting/wall.hpp"
#include "src/base/vector.hpp"
#include "src/report/drawings/svg.hpp"

namespace rockfold {

namespace {

constexpr Real page_width = 1000, left = 70, right = 30, top = 96, gap = 70;
constexpr Real largest_height = 640;  // px, of one panel

/// What a block is on the drawing.
struct Look {
  const char* fill;
  const char* words;
};
constexpr Look plain{"#f3f1ec", "rock that stays"}, held{"#a6d5a0", "key block, support adequate"},
    not_held{"#f4a582", "key block, support not adequate"}, unsupported{"#f4a582", "key block"},
    short_of{"#fee391", "stays, but below the target"};

/// A panel on the page: pixels of a point (u, v).
struct Chart {
  Point2 origin{};  ///< px, upper left corner
  Real scale = 1;   ///< px/m
  std::array<Real, 2> u{}, v{};
  bool around = false;

  Point2 at(const std::array<Real, 2>& uv) const {
    if (around) return {origin[0] + scale * (uv[1] - v[0]), origin[1] + scale * (uv[0] - u[0])};
    return {origin[0] + scale * (uv[0] - u[0]), origin[1] + scale * (v[1] - uv[1])};
  }
  Real width() const { return scale * (around ? v[1] - v[0] : u[1] - u[0]); }
  Real height() const { return scale * (around ? u[1] - u[0] : v[1] - v[0]); }
};

/// A round step that gives some ten ticks.
Real tick_step(Real length) {
  const Real rough = length / 10, decade = std::pow(10, std::floor(std::log10(rough)));
  for (const Real factor : {1.0, 2.0, 5.0})
    if (factor * decade >= rough) return factor * decade;
  return 10 * decade;
}

class Layout {
 public:
  Layout(const BlockArrays& blocks, const KeyblockReport& keyblocks, const SupportDesign& design,
         const Model& model, const Drawing& drawing)
      : blocks_(blocks),
        design_(design),
        model_(model),
        wall_(blocks, model, drawing.on, drawing.place),
        name_(drawing.on.name) {
    find_looks(keyblocks);
    find_extents();
    lay_charts();
  }

  std::string draw();

 private:
  void find_looks(const KeyblockReport& keyblocks);
  void find_extents();
  void lay_charts();
  Index chart_of(std::size_t face) const;
  Point2 place(std::size_t face, const Vec3& x) const;
  static std::string clip_name(std::size_t chart) { return "panel" + std::to_string(chart); }
  const Look& look_of(Index block) const;
  void draw_faces(Svg& svg) const;
  std::vector<Point2> bolt_places() const;
  static Point2 clear_of(const std::vector<Point2>& bolts, const Point2& at);
  void draw_numbers(Svg& svg) const;
  void draw_bolts(Svg& svg) const;
  void draw_axes(Svg& svg, const Chart& chart, const std::string& name) const;
  void draw_legend(Svg& svg) const;
  template <class Visit>
  void for_each_corner(Index face, Visit visit) const;

  const BlockArrays& blocks_;
  const SupportDesign& design_;
  const Model& model_;
  Wall wall_;
  std::string name_;
  std::unordered_map<Index, const Look*> look_;  ///< of blocks that are not plain
  std::vector<bool> useful_;                     ///< [bolts] it holds a key block
  std::vector<std::array<Real, 4>> extent_;      ///< [panels] u, v of what is on it
  std::vector<Chart> charts_;                    ///< [panels]
  std::vector<Index> block_of_face_;             ///< [faces of the wall]
  Real height_ = 0;
};

void Layout::find_looks(const KeyblockReport& keyblocks) {
  const auto& bolting = design_.bolting;
  for (std::size_t i = 0; i < keyblocks.keyblocks.size(); ++i) {
    for (const Index block : keyblocks.keyblocks[i].members)
      look_[block] = !bolting                              ? &unsupported
                     : bolting->keyblocks[i].held.adequate ? &held
                                                           : &not_held;
  }
  for (const auto& [stable, support] : staying_blocks(keyblocks, bolting ? &*bolting : nullptr)) {
    const bool adequate = support ? support->held.adequate : !(stable.support_force > 0);
    if (!adequate) look_[stable.block] = &short_of;
  }
  if (!bolting) return;
  useful_.assign(bolting->bolts.size(), false);
  for (const BlockSupport& support : bolting->keyblocks)
    for (const BoltCrossing& crossing : support.crossings)
      if (crossing.capacity > 0) useful_[crossing.bolt] = true;
}

template <class Visit>
void Layout::for_each_corner(Index face, Visit visit) const {
  for (Index loop = blocks_.loop_begin[face]; loop < blocks_.loop_begin[face + 1]; ++loop)
    for (Index c = blocks_.corner_begin[loop]; c < blocks_.corner_begin[loop + 1]; ++c)
      visit(blocks_.vertex[blocks_.corner_vertex[c]], loop);
}

Index Layout::chart_of(std::size_t face) const {
  const Index strip = wall_.strip_of(face);
  for (std::size_t p = 0; p < wall_.panels().size(); ++p) {
    const auto& strips = wall_.panels()[p].strips;
    if (std::find(strips.begin(), strips.end(), strip) != strips.end())
      return static_cast<Index>(p);
  }
  return 0;
}

void Layout::find_extents() {
  extent_.assign(wall_.panels().size(), {1e300, -1e300, 1e300, -1e300});
  for (std::size_t k = 0; k < wall_.faces().size(); ++k) {
    auto& e = extent_[chart_of(k)];
    for_each_corner(wall_.faces()[k], [&](const Vec3& x, Index) {
      const auto [u, v] = wall_.on_sheet(k, x);
      e = {std::min(e[0], u), std::max(e[1], u), std::min(e[2], v), std::max(e[3], v)};
    });
  }
  // The sheet of what runs round an axis is cut open opposite the crown.
  for (std::size_t p = 0; p < extent_.size(); ++p)
    if (const WallPanel& panel = wall_.panels()[p]; panel.around)
      extent_[p][0] = panel.u[0], extent_[p][1] = panel.u[1];
  // The block of each face of the wall; both ascend.
  Index block = 0;
  for (const Index face : wall_.faces()) {
    while (blocks_.face_begin[block + 1] <= face) ++block;
    block_of_face_.push_back(block);
  }
}

void Layout::lay_charts() {
  Real widest = 0, tallest = 0;
  for (std::size_t p = 0; p < extent_.size(); ++p) {
    const auto& e = extent_[p];
    const bool around = wall_.panels()[p].around;
    widest = std::max(widest, around ? e[3] - e[2] : e[1] - e[0]);
    tallest = std::max(tallest, around ? e[1] - e[0] : e[3] - e[2]);
  }
  const Real scale = std::min((page_width - left - right) / widest, largest_height / tallest);
  height_ = top;
  for (std::size_t p = 0; p < extent_.size(); ++p) {
    const auto& e = extent_[p];
    Chart chart{{left, height_ + 24}, scale, {e[0], e[1]}, {e[2], e[3]}, wall_.panels()[p].around};
    height_ += 24 + chart.height() + gap;
    charts_.push_back(chart);
  }
}

const Look& Layout::look_of(Index block) const {
  const auto found = look_.find(block);
  return found == look_.end() ? plain : *found->second;
}

void Layout::draw_faces(Svg& svg) const {
  for (std::size_t p = 0; p < charts_.size(); ++p)
    svg.clip_rectangle(
        clip_name(p), charts_[p].origin,
        {charts_[p].origin[0] + charts_[p].width(), charts_[p].origin[1] + charts_[p].height()});
  for (std::size_t k = 0; k < wall_.faces().size(); ++k) {
    const Index number = chart_of(k);
    const Chart& chart = charts_[number];
    // A face across the cut is drawn at both ends of the sheet.
    for (const Real turn : {0.0, 1.0, -1.0}) {
      const Real shift = turn * (chart.u[1] - chart.u[0]);
      if (turn != 0 && !chart.around) continue;
      std::vector<std::vector<Point2>> loops;
      Index last = none;
      bool seen = false;
      for_each_corner(wall_.faces()[k], [&](const Vec3& x, Index loop) {
        if (loop != last) loops.emplace_back();
        last = loop;
        const auto [u, v] = wall_.on_sheet(k, x);
        seen |= u + shift > chart.u[0] + 1e-9 && u + shift < chart.u[1] - 1e-9;
        loops.back().push_back(chart.at({u + shift, v}));
      });
      if (turn == 0 || seen)
        svg.polygon(loops,
                    {.stroke = "#9a948a", .width = 0.6, .fill = look_of(block_of_face_[k]).fill},
                    clip_name(static_cast<std::size_t>(number)));
    }
  }
}

/// A point of a face, brought back onto the sheet.
Point2 Layout::place(std::size_t face, const Vec3& x) const {
  const Chart& chart = charts_[chart_of(face)];
  auto [u, v] = wall_.on_sheet(face, x);
  const Real around = chart.u[1] - chart.u[0];
  if (chart.around && u > chart.u[1]) u -= around;
  if (chart.around && u < chart.u[0]) u += around;
  return chart.at({u, v});
}

/// Where on the drawing bolts stand, from left to right.
std::vector<Point2> Layout::bolt_places() const {
  std::vector<Point2> places;
  if (!design_.bolting) return places;
  for (const Bolt& bolt : design_.bolting->bolts)
    if (const auto face = wall_.face_at(bolt.collar)) places.push_back(place(*face, bolt.collar));
  std::sort(places.begin(), places.end());
  return places;
}

/// A place at most a line of text from `at`, the farthest from bolts; `at` itself where none is near.
Point2 Layout::clear_of(const std::vector<Point2>& bolts, const Point2& at) {
  constexpr Real line = 12;  // px
  Point2 best = at;
  Real farthest = -1;
  for (const auto& [dx, dy] : {std::pair{0, 0}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}}) {
    const Point2 there{at[0] + line * dx, at[1] + line * dy};
    Real nearest = line;
    for (auto bolt = std::lower_bound(bolts.begin(), bolts.end(), Point2{there[0] - line, 0});
         bolt != bolts.end() && (*bolt)[0] < there[0] + line; ++bolt)
      nearest = std::min(nearest, std::hypot((*bolt)[0] - there[0], (*bolt)[1] - there[1]));
    if (nearest > farthest) farthest = nearest, best = there;
  }
  return best;
}

/// On the largest face of each key block, where there is room.
void Layout::draw_numbers(Svg& svg) const {
  const std::vector<Point2> bolts = bolt_places();
  std::unordered_map<Index, std::size_t> largest;
  for (std::size_t k = 0; k < wall_.faces().size(); ++k) {
    const Index block = block_of_face_[k];
    if (look_.find(block) == look_.end()) continue;
    const auto [entry, added] = largest.emplace(block, k);
    if (blocks_.face_area[wall_.faces()[k]] > blocks_.face_area[wall_.faces()[entry->second]])
      entry->second = k;
  }
  for (std::size_t k = 0; k < wall_.faces().size(); ++k) {
    const Index block = block_of_face_[k];
    const auto found = largest.find(block);
    if (found == largest.end() || found->second != k) continue;
    const Chart& chart = charts_[chart_of(k)];
    const std::string number = std::to_string(block + 1);
    const Real room = blocks_.face_area[wall_.faces()[k]] * chart.scale * chart.scale;  // px²
    if (room < 110 * static_cast<Real>(number.size())) continue;
    Vec3 middle{};
    Real count = 0;
    for_each_corner(wall_.faces()[k], [&](const Vec3& x, Index) {
      middle += x;
      ++count;
    });
    const Point2 at = clear_of(bolts, place(k, (1 / count) * middle));
    svg.text({at[0], at[1] + 4}, number,
             {.size = 11, .anchor = "middle", .bold = true, .halo = true});
  }
}

void Layout::draw_bolts(Svg& svg) const {
  if (!design_.bolting) return;
  const auto& bolts = design_.bolting->bolts;
  for (std::size_t i = 0; i < bolts.size(); ++i) {
    const auto face = wall_.face_at(bolts[i].collar);
    if (!face) continue;
    const Point2 at = place(*face, bolts[i].collar);
    const char* colour = useful_[i] ? "#08519c" : "#8c8c8c";
    const bool spot = !design_.bolting->groups[bolts[i].group].is_pattern;
    if (spot)
      svg.square(at, 3.6, {.stroke = "white", .width = 0.8, .fill = colour});
    else
      svg.circle(at, useful_[i] ? 3.2 : 2.2, {.stroke = "white", .width = 0.6, .fill = colour});
  }
}

void Layout::draw_axes(Svg& svg, const Chart& chart, const std::string& name) const {
  const auto [x, y] = chart.origin;
  const Real w = chart.width(), h = chart.height();
  const auto& across = chart.around ? chart.v : chart.u;
  const auto& down = chart.around ? chart.u : chart.v;
  const Pen pen{.stroke = "#555555", .width = 0.8};
  svg.text({x, y - 9}, name, {.size = 13, .bold = true});
  svg.polygon({{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}}, pen);
  const Real step = tick_step(std::max(across[1] - across[0], down[1] - down[0]));
  const Real shift = chart.around ? 0 : chart.u[0];  // panels count from their own corner
  for (Real t = std::ceil((across[0] - shift) / step) * step; t <= across[1] - shift + 1e-9;
       t += step) {
    const Real px = x + chart.scale * (t + shift - across[0]);
    svg.line({px, y + h}, {px, y + h + 5}, pen);
    svg.text({px, y + h + 18}, fmt::format("{:g}", std::abs(t) < 1e-9 ? 0 : t),
             {.size = 11, .anchor = "middle"});
  }
  for (Real t = std::ceil(down[0] / step) * step; t <= down[1] + 1e-9; t += step) {
    const Real py =
        chart.around ? y + chart.scale * (t - down[0]) : y + chart.scale * (down[1] - t);
    svg.line({x - 5, py}, {x, py}, pen);
    svg.text({x - 9, py + 4}, fmt::format("{:g}", std::abs(t) < 1e-9 ? 0 : t),
             {.size = 11, .anchor = "end"});
  }
  svg.text({x + w / 2, y + h + 36},
           chart.around ? "along the axis, m" : "along the strike, m; upwards: up the dip, m",
           {.size = 11.5, .anchor = "middle", .colour = "#555555"});
  if (!chart.around) return;
  const Real crown = y + chart.scale * (0 - down[0]);
  svg.line({x, crown}, {x + w, crown}, {.stroke = "#555555", .width = 0.8, .dash = "8 4"});
  svg.text({x + w - 4, crown - 5}, "crown",
           {.size = 11, .anchor = "end", .colour = "#555555", .halo = true});
  svg.text({x + 4, y + 13}, "left", {.size = 11, .colour = "#555555", .halo = true});
  svg.text({x + 4, y + h - 5}, "right", {.size = 11, .colour = "#555555", .halo = true});
}

void Layout::draw_legend(Svg& svg) const {
  svg.text({left, 30}, (model_.title.empty() ? "" : model_.title + ": ") + "bolts on " + name_,
           {.size = 16, .bold = true});
  Real x = left;
  const auto entry = [&](const Look& look) {
    svg.square({x + 7, 58}, 6.5, {.stroke = "#9a948a", .width = 0.8, .fill = look.fill});
    svg.text({x + 20, 62}, look.words, {.size = 12});
    x += 44 + 6.2 * static_cast<Real>(std::char_traits<char>::length(look.words));
  };
  entry(plain);
  if (design_.bolting) {
    entry(held);
    entry(not_held);
  } else {
    entry(unsupported);
  }
  if (std::any_of(look_.begin(), look_.end(), [](const auto& l) { return l.second == &short_of; }))
    entry(short_of);
  if (!design_.bolting) return;
  x = left;
  const auto dot = [&](const char* colour, Real radius, const char* words) {
    svg.circle({x + 7, 80}, radius, {.stroke = "none", .fill = colour});
    svg.text({x + 20, 84}, words, {.size = 12});
    x += 44 + 6.2 * static_cast<Real>(std::char_traits<char>::length(words));
  };
  dot("#08519c", 3.6, "bolt that holds a key block (square: spot bolt)");
  dot("#8c8c8c", 2.6, "other bolt");
}

std::string Layout::draw() {
  Real width = 720;
  for (const Chart& chart : charts_) width = std::max(width, left + chart.width() + right);
  Svg svg(width, height_);
  draw_legend(svg);
  draw_faces(svg);
  for (std::size_t p = 0; p < charts_.size(); ++p)
    draw_axes(svg, charts_[p], wall_.panels()[p].name);
  draw_bolts(svg);
  draw_numbers(svg);
  return svg.document("Bolt layout of " + name_);
}

}  // namespace

std::string bolt_layout(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model, const Drawing& drawing) {
  return Layout(blocks, keyblocks, design, model, drawing).draw();
}

}  // namespace rockfold
