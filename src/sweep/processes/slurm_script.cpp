#include "src/sweep/processes/slurm_script.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "src/sweep/sweep_table.hpp"

namespace fs = std::filesystem;

namespace rockfold::sweep {

namespace {

/// One word for a shell, whatever stands in it.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string absolute(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

/// This program with what the user gave beside the mode.
std::string command(const Options& options, const std::string& folder) {
  std::error_code ignored;
  std::string text = quoted(fs::read_symlink("/proc/self/exe", ignored).string()) + " sweep " +
                     quoted(absolute(options.input)) + " -o " + quoted(absolute(folder));
  for (const std::string& change : options.overrides) text += " --set " + quoted(change);
  for (const std::string& load : options.ignored) text += " --ignore " + quoted(load);
  if (options.yes) text += " --yes";
  if (options.seed) text += fmt::format(" --seed {}", *options.seed);
  if (options.threads > 0) text += fmt::format(" --threads {}", options.threads);
  return text;
}

/// Of the task: as many runs at a time as workers, each of the size that one may have.
std::string resources(const Options& options, const SweepSpec& spec) {
  const Index workers = std::max<Index>(1, spec.workers);
  std::string text =
      fmt::format("#SBATCH --cpus-per-task={}\n", workers * std::max(1, options.threads));
  if (spec.memory_limit > 0)
    text +=
        fmt::format("#SBATCH --mem={}M\n",
                    static_cast<long long>(std::ceil(spec.memory_limit * Real(workers) / 1048576)));
  return text;
}

}  // namespace

std::string write_slurm_scripts(const Options& options, const SweepSpec& spec,
                                const std::string& folder) {
  std::error_code error;
  fs::create_directories(fs::path(folder) / "logs", error);
  if (error)
    throw Error(ErrorKind::io, "cannot be made: " + error.message(), Place{folder, 0, 0, ""});
  const std::string at = absolute(folder), name = fs::path(options.input).stem().string();
  const auto path = [&](const char* file) { return (fs::path(folder) / file).string(); };
  const auto head = [&](const std::string& job, const std::string& log) {
    return fmt::format("#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --output={}\n", quoted(job),
                       quoted(at + "/logs/" + log));
  };
  write_text(
      path("runs.sbatch"),
      head(name, "%A_%a.log") + fmt::format("#SBATCH --array=1-{}\n", options.slurm_tasks) +
          resources(options, spec) +
          fmt::format(
              "# Each task computes its part of the runs; submitted again, what is missing.\n"
              "exec {} --quiet --workers {} --part \"$SLURM_ARRAY_TASK_ID/{}\"\n",
              command(options, folder), std::max<Index>(1, spec.workers), options.slurm_tasks));
  write_text(path("gather.sbatch"),
             head(name + " table", "%j.log") + fmt::format("exec {} --gather{}\n",
                                                           command(options, folder),
                                                           options.report ? " --report" : ""));
  write_text(path("submit.sh"),
             fmt::format("#!/bin/sh\n# Options of sbatch (--partition, --time, --account, …) are "
                         "handed on to both jobs.\n"
                         "set -e\n"
                         "job=$(sbatch --parsable \"$@\" {0})\n"
                         "sbatch --parsable --dependency=\"afterany:${{job%%;*}}\" \"$@\" {1}\n",
                         quoted(at + "/runs.sbatch"), quoted(at + "/gather.sbatch")));
  fs::permissions(path("submit.sh"), fs::perms::owner_exec | fs::perms::group_exec,
                  fs::perm_options::add, error);
  return path("submit.sh");
}

}  // namespace rockfold::sweep
