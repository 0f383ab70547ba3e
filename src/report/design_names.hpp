// How reports call bolts, their classes and the ratings of rock.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/bolting/bolting.hpp"

namespace rockfold {

constexpr const char* coupling_name(Coupling coupling) {
  switch (coupling) {
    case Coupling::cmc:
      return "CMC";
    case Coupling::cfc:
      return "CFC";
    case Coupling::dmfc:
      return "DMFC";
  }
  return "";
}

constexpr const char* category_name(BoltCategory category) {
  switch (category) {
    case BoltCategory::rock_bolt:
      return "rock_bolt";
    case BoltCategory::cable_bolt:
      return "cable_bolt";
    case BoltCategory::ground_anchor:
      return "ground_anchor";
  }
  return "";
}

/// "systematic.12", or the name of a single bolt.
inline std::string bolt_name(const BoltingReport& bolting, Index id) {
  const Bolt& bolt = bolting.bolts[id];
  const BoltGroup& group = bolting.groups[bolt.group];
  return group.is_pattern ? group.name + "." + std::to_string(bolt.number) : group.name;
}

constexpr std::array<const char*, 6> rmr_parameters{
    "strength", "rqd", "spacing", "joint_condition", "groundwater", "orientation"};
constexpr std::array<const char*, 5> rmr_classes{"I", "II", "III", "IV", "V"};
constexpr std::array<const char*, 5> rmr_rock{"very good rock", "good rock", "fair rock",
                                              "poor rock", "very poor rock"};

/// "12", of a group "12+15".
inline std::string block_ids(const std::vector<Index>& members) {
  std::string text;
  for (const Index block : members) text += (text.empty() ? "" : "+") + std::to_string(block + 1);
  return text;
}

/// "12, 15 and 3 more", of at most eight.
inline std::string block_list(const std::vector<Index>& blocks) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < blocks.size() && i < most; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(blocks[i] + 1);
  if (blocks.size() > most) text += " and " + std::to_string(blocks.size() - most) + " more";
  return text;
}

}  // namespace rockfold
