// The certificate of a factor: written by `rockfold stability`, checked by `rockfold verify`.
#pragma once

#include <string>

#include "host/stability/stability.hpp"
#include "src/app/command_line.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Whether there is a bound to prove: forces that balance the mass at some factor, but not at every one.
bool has_certificate(const StabilityReport& report);

/// Writes what proves the bound, once it has been checked. Throws Error(io) where the file cannot be written, Error(analysis) where the
/// certificate does not hold: then the search went wrong. Of a mass without a bound there is none, and a warning says so.
void write_certificate(const std::string& path, const StabilityReport& report, Terminal& terminal);

/// Prints what the certificate proves; returns the exit status. Throws Error(io) where the file holds none, Error(analysis) where it proves
/// nothing.
int verify_certificate(const Options& options);

}  // namespace rockfold
