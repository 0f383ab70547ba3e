// Key blocks of a tunnel in rock whose joints are drawn at random. docs/block_theory.md, "Probability".
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/theory/theory_block.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A probability with its confidence bounds (Wilson 1927).
struct Probability {
  Index count = 0;  ///< realisations
  Real value = 0, low = 0, high = 0;
};

/// A quantile with bounds that no assumption about the distribution enters (order statistics);
/// NaN where the sample is too small for a bound.
struct Quantile {
  Real level = 0;
  Real value = 0, low = 0, high = 0;
};

/// Of the realisations in which there is something to measure.
struct SampleDistribution {
  Index count = 0;
  Real mean = 0, mean_low = 0, mean_high = 0;  ///< with the bounds of a large sample
  Real deviation = 0;                          ///< standard deviation
  Real least = 0, greatest = 0;
  std::vector<Quantile> quantiles;  ///< at 5, 25, 50, 75, 90, 95 and 99 per cent
};

/// Of one joint pyramid.
struct PyramidProbability {
  std::string code;
  Probability block;          ///< a finite block stands over the tunnel
  Probability key;            ///< and moves
  SampleDistribution volume;  ///< m³, of its largest block where it moves
};

struct MonteCarloResult {
  Index realisations = 0;
  std::uint64_t seed = 0;
  Real length = 0, reach = 0;  ///< m
  Probability key;             ///< any key block along the length
  std::vector<PyramidProbability> pyramids;
  SampleDistribution key_blocks;        ///< pyramids with a key block, of all realisations
  SampleDistribution largest_volume;    ///< m³, where there is a key block
  SampleDistribution support_pressure;  ///< Pa, the largest, where there is one
  SampleDistribution support_force;     ///< N, of all largest blocks together, where there is one
};

/// Each realisation draws orientation (Fisher), position and spacing of each set and its strength,
/// and looks for the largest block of each joint pyramid of three sets whose apex lies along
/// `length` of tunnel. In parallel; the result depends on the seed alone, not on the threads.
/// Throws Error(model) for a section with inward corners and for spacings too small for the reach.
MonteCarloResult simulate_tunnel(const Model& model, const TheoryTunnel& tunnel,
                                 const MonteCarloSpec& spec);

Probability probability(Index count, Index of, Real confidence);
SampleDistribution distribution(std::vector<Real> sample, Real confidence);

}  // namespace rockfold
