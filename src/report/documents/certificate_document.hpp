// The certificate of a factor as a JSON document, written by `stability` and read by `verify`:
//
//   {"rockfold": "certificate/1",
//    "bodies": [{"block": 12, "centre": [x, y, z], "force": [x, y, z], "moment": [x, y, z]}, …],
//    "contacts": [{"bodies": [1, 0], "joint": "J1", "normal": [x, y, z], "corners": [[x, y, z], …],
//                  "friction": 0.7, "cohesion": 0.0, "tension": 0.0}, …],
//    "bound": {"below": {"factor": 1.2, "forces": [[x, y, z], …]},
//              "above": {"factor": 1.3, "velocities": [[vx, vy, vz, wx, wy, wz], …]}},
//    "sliding": {"factor": 1.2, "forces": […], "velocities": […]}}
//
// In metres, newtons, pascals, metres a second and radians a second. Blocks count from 1, as do "bodies" of contacts; 0 there is held rock.
// "sliding" is null where there is none. Numbers come back bit by bit.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "host/stability/certificate.hpp"

namespace rockfold {

nlohmann::ordered_json certificate_document(const Certificate& certificate);

/// Throws Error(io) with the file and the key where `text` is no such document. Whether the numbers make sense is for verify() to say.
Certificate certificate_from(const std::string& text, const std::string& file);

/// The certificate in a file.
Certificate read_certificate(const std::string& file);

}  // namespace rockfold
