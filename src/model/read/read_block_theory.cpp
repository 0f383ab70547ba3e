// [block_theory]: joint sets alone, without a cut model.
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

/// Calls read(reader, number) for each table of the array under `key`.
template <class Read>
void read_list(TableReader& in, const std::string& key, Read read) {
  const auto* value = in.find(key);
  if (!value) return;
  const auto* entries = std::get_if<Array>(&value->data);
  if (!entries) {
    in.wrong(key, "there may be many of these: write [[" + in.path_of(key) + "]]");
    return;
  }
  for (std::size_t i = 0; i < entries->size(); ++i) {
    TableReader entry((*entries)[i], item_path(in.path_of(key), i), in.out());
    if (entry.is_table()) read(entry, static_cast<Index>(i + 1));
  }
}

void read_tunnels(TableReader& in, TheorySpec& theory) {
  Names names("tunnel", "block_theory.tunnel");
  read_list(in, "tunnel", [&](TableReader& entry, Index number) {
    TheoryTunnel tunnel;
    tunnel.name = entry.read_name(names, "tunnel" + std::to_string(number));
    tunnel.place = entry.place();
    entry.read("trend", tunnel.trend, between(0, 360, "deg clockwise from north"));
    Range plunge = between(0, 90, "deg below the horizontal");
    plunge.high_open = true;
    entry.read("plunge", tunnel.plunge, plunge, Need::optional);
    tunnel.section = read_tunnel_section(entry);
    theory.tunnels.push_back(std::move(tunnel));
  });
}

void read_slopes(TableReader& in, TheorySpec& theory) {
  Names names("slope", "block_theory.slope");
  read_list(in, "slope", [&](TableReader& entry, Index number) {
    TheorySlope slope;
    slope.name = entry.read_name(names, "slope" + std::to_string(number));
    slope.place = entry.place();
    const bool face = read_dip(entry, slope.face);
    slope.upper.dip_direction = slope.face.dip_direction;
    entry.read("height", slope.height, length());
    entry.read("upper_dip", slope.upper.dip, between(0, 90, "deg"), Need::optional);
    entry.read("upper_dip_direction", slope.upper.dip_direction,
               between(0, 360, "deg clockwise from north"), Need::optional);
    if (face && slope.face.dip == 0)
      entry.wrong("dip", "found 0, must be > 0 (deg): a slope face is not level");
    else if (face && slope.upper.dip >= slope.face.dip)
      entry.wrong("upper_dip", "found " + number_text(slope.upper.dip) + ", must be < dip's " +
                                   number_text(slope.face.dip) +
                                   " (deg): the ground behind the crest is flatter than the face");
    theory.slopes.push_back(std::move(slope));
  });
}

void read_scan(TableReader& in, TheorySpec& theory) {
  const auto* value = in.find("scan");
  if (!value) return;
  TableReader entry(*value, in.path_of("scan"), in.out());
  if (!entry.is_table()) return;
  TheoryScan scan;
  entry.read("step", scan.step, between(1, 90, "deg"), Need::optional);
  if (const auto* list = entry.find("plunges")) {
    const auto* plunges =
        array_from(*list, entry.path_of("plunges"), 1, "number (deg)", entry.out());
    scan.plunges.clear();
    for (std::size_t i = 0; plunges && i < plunges->size(); ++i)
      if (const auto plunge = real_from((*plunges)[i], item_path(entry.path_of("plunges"), i),
                                        between(0, 89, "deg below the horizontal"), entry.out()))
        scan.plunges.push_back(*plunge);
  }
  if (theory.tunnels.empty() && theory.slopes.empty())
    entry.wrong("",
                "there is neither a [[block_theory.tunnel]] nor a [[block_theory.slope]] to turn");
  theory.scan = scan;
}

void read_monte_carlo(TableReader& in, TheorySpec& theory) {
  const auto* value = in.find("monte_carlo");
  if (!value) return;
  TableReader entry(*value, in.path_of("monte_carlo"), in.out());
  if (!entry.is_table()) return;
  MonteCarloSpec spec;
  spec.place = entry.place();
  entry.read("realisations", spec.realisations, IntegerRange{.low = 2, .high = 10'000'000},
             Need::optional);
  Index seed = 1;
  if (entry.read("seed", seed, IntegerRange{.low = 0}, Need::optional))
    spec.seed = static_cast<std::uint64_t>(seed);
  entry.read("length", spec.length, length(), Need::optional);
  entry.read("reach", spec.reach, length());
  entry.read("friction_angle_deviation", spec.friction_deviation, between(0, 45, "deg"),
             Need::optional);
  entry.read("cohesion_variation", spec.cohesion_variation,
             between(0, 10, "standard deviation over mean"), Need::optional);
  Range confidence = between(0, 1, "");
  confidence.low_open = confidence.high_open = true;
  entry.read("confidence", spec.confidence, confidence, Need::optional);
  if (theory.tunnels.empty())
    entry.wrong("", "there is no [[block_theory.tunnel]] whose joints could be drawn");
  theory.monte_carlo = spec;
}

}  // namespace

void read_block_theory(Draft& draft) {
  read_section(draft, "block_theory", [&](TableReader& in) {
    TheorySpec theory;
    theory.place = in.place();
    in.read_reference("material", draft.materials, theory.material);
    read_tunnels(in, theory);
    read_slopes(in, theory);
    read_scan(in, theory);
    read_monte_carlo(in, theory);
    draft.model.theory = std::move(theory);
  });
}

}  // namespace rockfold
