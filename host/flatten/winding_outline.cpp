#include <algorithm>
#include <array>
#include <utility>

#include "host/flatten/winding_outline_exact.hpp"

namespace rockfold {

void EdgeCount::add(Index from, Index to, int passes) {
  if (from < to)
    passes_[{from, to}] += passes;
  else if (to < from)
    passes_[{to, from}] -= passes;
}

int EdgeCount::of(Index from, Index to) const {
  const auto found = passes_.find({std::min(from, to), std::max(from, to)});
  if (found == passes_.end()) return 0;
  return from < to ? found->second : -found->second;
}

int EdgeCount::take(Index from, Index to) {
  const int passes = of(from, to);
  passes_.erase({std::min(from, to), std::max(from, to)});
  return passes;
}

void WindingOutline::draw(Vertex from, Vertex to, int passes) {
  std::vector<Segment> open{{from, to, passes}};
  while (!open.empty()) {
    const Segment segment = open.back();
    open.pop_back();
    if (segment.from == segment.to || segment.passes == 0) continue;
    const View view = look(segment.from, segment.to);
    if (view.barrier.first != nullptr && bends_ > 0) {
      --bends_;
      bend(segment, view.barrier, open);
      continue;
    }
    Vertex at = segment.from;
    if (view.barrier.first != nullptr)
      for (const Vertex next : view.on_left) lay(std::exchange(at, next), next, segment.passes);
    lay(at, view.reached, segment.passes);
    open.push_back({view.reached, segment.to, segment.passes});
  }
}

int WindingOutline::across(int here, Plan::Face_handle face, int k) const {
  if (!plan_.is_constrained({face, k})) return here;
  return here - laid_.of(face->vertex(Plan::ccw(k))->info(), face->vertex(Plan::cw(k))->info());
}

/// Goes around `from` to the triangle that the way to `to` leads through, or the edge that it runs along.
WindingOutline::View WindingOutline::look(Vertex from, Vertex to) const {
  const auto ahead = [&](Vertex v) {
    return plan_.orientation(from->point(), to->point(), v->point()) == CGAL::COLLINEAR &&
           plan_.geom_traits().collinear_are_ordered_along_line_2_object()(from->point(),
                                                                           v->point(), to->point());
  };
  Plan::Edge entry{{}, 0};
  auto face = plan_.incident_faces(from);
  const auto first = face;
  do {
    if (plan_.is_infinite(face)) continue;
    const int k = face->index(from);
    const Vertex right = face->vertex(Plan::ccw(k)), left = face->vertex(Plan::cw(k));
    if (ahead(right)) return {right};
    if (ahead(left)) return {left};
    if (plan_.orientation(from->point(), to->point(), right->point()) == CGAL::RIGHT_TURN &&
        plan_.orientation(from->point(), to->point(), left->point()) == CGAL::LEFT_TURN)
      entry = {face, k};
  } while (++face != first);
  return look_across(entry, from, to);
}

/// Goes from triangle to triangle, into the first one's edge, to the first vertex on the way.
WindingOutline::View WindingOutline::look_across(Plan::Edge edge, Vertex from, Vertex to) const {
  View view;
  for (;;) {
    const auto [face, k] = edge;
    const Vertex right = face->vertex(Plan::ccw(k)), left = face->vertex(Plan::cw(k));
    if (view.on_left.empty() || view.on_left.back() != left) view.on_left.push_back(left);
    if (view.barrier.first == nullptr && plan_.is_constrained(edge)) view.barrier = edge;
    const auto next = face->neighbor(k);
    view.reached = plan_.mirror_vertex(face, k);
    const auto side = plan_.orientation(from->point(), to->point(), view.reached->point());
    if (side == CGAL::COLLINEAR) return view;
    edge = {next, next->index(side == CGAL::LEFT_TURN ? left : right)};
  }
}

/// Replaces the segment, or the barrier across it, by two through the vertex that lies nearest.
void WindingOutline::bend(const Segment& segment, Plan::Edge barrier, std::vector<Segment>& open) {
  const Vertex a = segment.from, b = segment.to;
  const Vertex c = barrier.first->vertex(Plan::ccw(barrier.second)),
               d = barrier.first->vertex(Plan::cw(barrier.second));
  const Kernel::Segment_2 ab(a->point(), b->point()), cd(c->point(), d->point());
  struct Choice {
    Real distance2;
    Vertex vertex;
  };
  const std::array<Choice, 4> choices{{{CGAL::squared_distance(c->point(), ab), c},
                                       {CGAL::squared_distance(d->point(), ab), d},
                                       {CGAL::squared_distance(a->point(), cd), a},
                                       {CGAL::squared_distance(b->point(), cd), b}}};
  const Vertex nearest =
      std::min_element(choices.begin(), choices.end(), [](const Choice& p, const Choice& q) {
        return p.distance2 < q.distance2;
      })->vertex;
  if (nearest == c || nearest == d) {
    open.push_back({nearest, b, segment.passes});
    open.push_back({a, nearest, segment.passes});
  } else {
    const int passes = laid_.take(c->info(), d->info());
    plan_.remove_constrained_edge(barrier.first, barrier.second);
    open.push_back(segment);
    open.push_back({nearest, d, passes});
    open.push_back({c, nearest, passes});
  }
}

void WindingOutline::lay(Vertex from, Vertex to, int passes) {
  plan_.insert_constraint(from, to);
  laid_.add(from->info(), to->info(), passes);
}

}  // namespace rockfold
