// The table of a sweep, and what its runs say together.
#pragma once

#include <string>
#include <vector>

#include "src/report/documents/documents.hpp"
#include "src/sweep/statistics.hpp"
#include "src/sweep/sweep_record.hpp"

namespace rockfold::sweep {

/// Runs by number, those that have ended.
struct SweepTable {
  const SweepSpec& spec;
  const std::vector<std::vector<std::string>>& values;  ///< [all runs][parameters]
  std::vector<RunRecord> rows;
};

/// Failed ones and those beyond a limit, by number.
std::vector<RunRecord> not_done(const SweepTable& table);
/// `status` is that of a run.
Index count_of(const SweepTable& table, const std::string& status);
/// [rows] A column as numbers: a parameter's key or a result's name; NaN where there is none.
std::vector<Real> numbers_of(const SweepTable& table, const std::string& column);
/// Whether `column` has a number, or a null that says that there is none, in any run that is done. If not, its path leads nowhere.
bool is_answered(const SweepTable& table, const std::string& column);
/// Runs that are done and have no number in `column`.
Index runs_without(const SweepTable& table, const std::string& column);

/// The columns: run,status,seconds,error, then parameters, results, events.
std::string csv_text(const SweepTable& table);
/// Written aside. Throws Error(io).
void write_text(const std::string& path, const std::string& text);
/// DIR/sweep.csv and DIR/sweep.h5, written aside. Throws Error(io).
void write_tables(const SweepTable& table, const std::string& folder);
Json sweep_document(const SweepTable& table, const std::string& folder);
std::string sweep_summary(const SweepTable& table, const std::string& folder);

}  // namespace rockfold::sweep
