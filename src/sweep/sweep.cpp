#include "src/sweep/sweep.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/app/answers.hpp"
#include "src/app/process/signals.hpp"
#include "src/base/interrupt.hpp"
#include "src/report/error_text.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/sweep/processes/mpi_link.hpp"
#include "src/sweep/processes/run_pool.hpp"
#include "src/sweep/processes/run_queue.hpp"
#include "src/sweep/processes/slurm_script.hpp"
#include "src/sweep/sweep_page.hpp"
#include "src/sweep/sweep_runs.hpp"
#include "src/sweep/sweep_table.hpp"

namespace fs = std::filesystem;

namespace rockfold {

namespace sweep {
namespace {

std::string folder_of(const Options& options) {
  if (!options.output.empty()) return options.output;
  return fs::path(options.input).replace_extension("").string();
}

/// Files of runs under way.
void make_run_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(fs::path(folder) / "runs", error);
  if (error)
    throw Error(ErrorKind::io, "cannot be made: " + error.message(), Place{folder, 0, 0, ""});
}

class Sweep {
 public:
  Sweep(const Options& options, const SweepSpec& spec)
      : options_(options),
        spec_(spec),
        folder_(folder_of(options)),
        runs_(options, spec, folder_) {}

  /// Computes what has not ended yet and gathers the table.
  int go(Terminal& terminal, MpiLink* link);
  /// Computes each N-th run into a journal of its own.
  int compute_part(Terminal& terminal);
  /// Computes what rank 0 hands out.
  int help(MpiLink& link);

 private:
  PoolSettings pool_settings() const;
  std::vector<Index> missing(const std::vector<RunRecord>& ended) const;
  void compute(RunQueue& queue);
  void compute_all(const std::vector<Index>& left, SweepRecord& record, Terminal& terminal,
                   MpiLink* link);
  void warn(const SweepTable& table, Terminal& terminal) const;

  const Options& options_;
  const SweepSpec& spec_;
  std::string folder_;
  SweepRuns runs_;
};

PoolSettings Sweep::pool_settings() const {
  const Index wanted = options_.workers > 0 ? options_.workers : spec_.workers;
  return {wanted > 0 ? wanted : core_count(), spec_.time_limit, spec_.memory_limit};
}

std::vector<Index> Sweep::missing(const std::vector<RunRecord>& ended) const {
  std::set<Index> known;
  for (const RunRecord& row : ended) known.insert(row.run);
  std::vector<Index> left;
  for (Index run = 1; run <= std::ssize(runs_.values()); ++run)
    if (!known.contains(run)) left.push_back(run);
  return left;
}

void Sweep::compute(RunQueue& queue) {
  make_run_folder(folder_);
  run_jobs(
      pool_settings(), queue, [&](Index run) { return runs_.job_of(run); },
      [&](const Ended& end) {
        const RunRecord row = runs_.outcome(end);
        queue.ended(row);
        runs_.clear(row.run, row.status == "done" ? Left::nothing : Left::answer);
      });
  queue.close();
}

void Sweep::compute_all(const std::vector<Index>& left, SweepRecord& record, Terminal& terminal,
                        MpiLink* link) {
  remember_interrupts();
  terminal.begin("sweep", std::ssize(left), "runs");
  Index count = 0;
  const auto queue = list_queue(
      left,
      [&](const RunRecord& row) {
        record.add(row);
        terminal.done(++count);
      },
      link);
  compute(*queue);
  analysis_is_over();
  terminal.end();
}

int Sweep::help(MpiLink& link) {
  remember_interrupts();
  compute(*remote_queue(link));
  return 0;
}

int Sweep::compute_part(Terminal& terminal) {
  const auto [part, parts] = options_.part;
  SweepRecord record(part_folder(folder_, part), runs_.identity());
  std::vector<RunRecord> ended = read_runs(folder_, runs_.identity());
  ended.insert(ended.end(), record.runs().begin(), record.runs().end());
  std::vector<Index> left = missing(ended);
  std::erase_if(
      left, [&, part = part, parts = parts](Index run) { return (run - 1) % parts != part - 1; });
  compute_all(left, record, terminal, nullptr);
  return interrupted_status();
}

void Sweep::warn(const SweepTable& table, Terminal& terminal) const {
  for (const Result& result : spec_.results)
    if (count_of(table, "done") > 0 && spread_of(numbers_of(table, result.name)).count == 0)
      terminal.warn(fmt::format("result '{}': {}", result.name,
                                is_answered(table, result.name)
                                    ? result.path + " is null in every run"
                                    : "no run's document has a number at " + result.path));
  const std::size_t all = runs_.values().size();
  const std::string ended =
      fmt::format("{} of {} runs have ended; the same command goes on", table.rows.size(), all);
  if (const auto limit = stop_error(ended))
    terminal.warn(error_lines(*limit).front());
  else if (interrupt_signal != 0)
    terminal.warn("interrupted: " + ended);
  else if (table.rows.size() < all)
    terminal.warn(
        fmt::format("{} of {} runs have ended: submit the others again, or sweep without "
                    "--gather",
                    table.rows.size(), all));
}

int Sweep::go(Terminal& terminal, MpiLink* link) {
  SweepRecord record(folder_, runs_.identity());
  for (const std::string& part : part_folders(folder_)) {
    std::set<Index> known;
    for (const RunRecord& row : record.runs()) known.insert(row.run);
    for (const RunRecord& row : read_runs(part, runs_.identity()))
      if (!known.contains(row.run)) record.add(row);
  }
  if (!options_.gather) compute_all(missing(record.runs()), record, terminal, link);
  SweepTable table{spec_, runs_.values(), record.runs()};
  std::sort(table.rows.begin(), table.rows.end(),
            [](const auto& a, const auto& b) { return a.run < b.run; });
  write_tables(table, folder_);
  if (options_.report) write_page(table, folder_);
  warn(table, terminal);
  print_made(
      options_, terminal.warnings(), sweep_document(table, folder_),
      sweep_summary(table, folder_) + (options_.report ? fact("report", page_path(folder_)) : ""));
  if (interrupt_signal != 0) return interrupted_status();
  return count_of(table, "done") == std::ssize(runs_.values()) ? 0 : 1;
}

/// Scripts are made once the sweep is known to be one.
int write_scripts(const Options& options, const SweepSpec& spec) {
  const std::string folder = folder_of(options);
  const SweepRuns runs(options, spec, folder);
  const std::string submit = write_slurm_scripts(options, spec, folder);
  Json document = head_json({"sweep", "", spec.seed});
  document["folder"] = folder;
  document["submit"] = submit;
  document["totals"] = {{"runs", runs.values().size()}, {"tasks", options.slurm_tasks}};
  print_made(options, {}, document,
             fact("runs", fmt::format("{} in {} tasks of a job array", runs.values().size(),
                                      options.slurm_tasks)) +
                 fact("submit", submit + "  (options of sbatch behind it)"));
  return 0;
}

}  // namespace
}  // namespace sweep

int run_sweep(const Options& options, Terminal& terminal) {
  sweep::SweepSpec spec = sweep::read_sweep(options.input);
  if (options.seed) spec.seed = *options.seed;
  if (options.slurm_tasks > 0) return sweep::write_scripts(options, spec);
  sweep::Sweep sweep(options, spec);
  if (options.part.first > 0) return sweep.compute_part(terminal);
  const auto link = options.gather ? nullptr : sweep::MpiLink::open();
  if (link && link->rank() > 0) return sweep.help(*link);
  return sweep.go(terminal, link.get());
}

}  // namespace rockfold
