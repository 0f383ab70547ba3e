#include "src/app/help_text.hpp"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr std::array<CommandHelp, 16> helps{{
    {Command::demo, "demo", "", "the built-in rock slope: blocks, key blocks, what slides",
     "Takes a jointed rock slope that is part of the program through all stages: blocks, key "
     "blocks with\n"
     "their support, the first second of their motion. The result file is "
     "rockfold_demo.vtkhdf in\n"
     "the current folder, unless -o names another; rockfold_demo.html beside it is a page to look "
     "at it.\n",
     "  rockfold demo\n"
     "      prints a summary; open rockfold_demo.html in a browser\n"},
    {Command::check, "check", "MODEL.toml", "validate a model and stop",
     "Reads the model and the files that it names and tells all of their errors at once, each "
     "with\n"
     "file:line:column, the key, what is wrong and what would be right. If there are none, it "
     "builds\n"
     "the solids and places the joints, as cut does before joints cut the rock. Nothing is "
     "written.\n",
     "  rockfold check slope.toml\n"
     "      exit status 0 if the model is right, 2 if not, 3 if a file cannot be read\n"},
    {Command::cut, "cut", "MODEL.toml", "cut the rock into blocks",
     "Cuts the model's solids by its joints, exactly, and writes the blocks to a result file. "
     "Tells "
     "how\n"
     "large the blocks are and of which shape, how densely the rock is jointed, and what each "
     "stage "
     "of\n"
     "an excavation removes.\n",
     "  rockfold cut slope.toml --json > blocks.json\n"
     "      volume, centroid, faces, edges and vertices of each block; also writes slope.vtkhdf\n"
     "  rockfold cut slope.toml --export slope.vtp --export slope.3ddat\n"
     "      the blocks for ParaView and for 3DEC\n"},
    {Command::support, "support", "MODEL.toml",
     "key blocks in batches, and the support that they need",
     "Cuts the rock into blocks, finds those that can move (key blocks) and how, in batches: those "
     "that\n"
     "can move when the first ones are gone are the second batch, and so on. For each the support "
     "force\n"
     "and pressure for the target factor of safety. A model without [support] has its defaults.\n",
     "  rockfold support slope.toml --set support.target_factor_of_safety=1.3\n"
     "      the same model for another factor of safety\n"},
    {Command::stability, "stability", "MODEL.toml",
     "the factor at which the whole mass fails, and its bound",
     "Cuts the rock into blocks and asks of all of them together, as rigid blocks, by how much "
     "the\n"
     "strength of all joints may be divided before they fail: the factor that no mass of these\n"
     "blocks exceeds (bound), proved by forces and by velocities, and the one at which a mass\n"
     "without dilation fails (sliding), how it moves, and forces that make a state of collapse.\n"
     "--certificate keeps the proof, and `rockfold verify` checks it in rational arithmetic.\n",
     "  rockfold stability slope.toml --certificate slope.certificate.json\n"
     "  rockfold verify slope.certificate.json\n"},
    {Command::verify, "verify", "CERTIFICATE", "check what proves a factor of the whole mass",
     "Checks a certificate that `rockfold stability --certificate` has written, in rational\n"
     "arithmetic and from its own numbers alone: that its forces balance every block and break no\n"
     "strength at the lower factor, and that at the upper one the loads do more work on its\n"
     "velocities than the strength can take up. Names the first thing that is wrong.\n",
     "  rockfold verify slope.certificate.json\n"
     "      exit status 0 if it holds, 1 if not, 3 if the file holds no certificate\n"},
    {Command::theory, "theory", "MODEL.toml",
     "block theory of the joint sets alone, no rock is cut",
     "Tells what the model's joint sets make of its [block_theory]: all joint pyramids and how "
     "their\n"
     "blocks move, the largest blocks of tunnels and slopes and the support that they need, the "
     "best\n"
     "and worst directions of a scan, and the probability of key blocks where joints are drawn at\n"
     "random. Needs no [[solid]] and writes no result file.\n",
     "  rockfold theory adit.toml --json > adit.json\n"
     "      the same tables as one JSON document\n"},
    {Command::sets, "sets", "TABLE",
     "joint sets of a survey: means, scatter, spacings, a stereonet",
     "Reads a table of measured joints (dip, dip_direction or strike, ...; places need not be "
     "there)\n"
     "and tells its sets: mean planes, Fisher's kappa and cones, spacings. A column set counts;\n"
     "without one, sets are found among the poles, as many as the poles tell of. Where a scanline\n"
     "is known, joints along it are weighed by Terzaghi's 1/|cos d|.\n",
     "  rockfold sets scanline.csv --scanline 045/10 -o sets.toml --picture net.svg\n"
     "      sets.toml has a [[joint_set]] for each; net.svg the poles, their density and the "
     "means\n"},
    {Command::run, "run", "MODEL.toml", "covers and analysis; support too where [support] stands",
     "Cuts the rock, lays covers over it and carries out the model's [analysis]; finds key blocks "
     "too\n"
     "where the model has a [support] table. Ctrl-C ends it at the last step done, keeps the\n"
     "states so far and a checkpoint, and exits with status 130; a second Ctrl-C exits at once.\n"
     "`rockfold resume` goes on, also after a crash.\n",
     "  rockfold run slope.toml -o /tmp/slope.vtkhdf --threads 2\n"
     "      states every output.every steps go to /tmp/slope.vtkhdf\n"},
    {Command::resume, "resume", "OUT.vtkhdf", "go on with an interrupted run",
     "Goes on from the last checkpoint of a run that was interrupted or killed, to the end that "
     "it\n"
     "would have come to, bit by bit, and tells of the whole run. Of a finished run it prints the\n"
     "document. The model and the files that it reads must be as they were; --set may give\n"
     "analysis.end_time or analysis.steps another value.\n",
     "  rockfold resume slope.vtkhdf\n"
     "      after Ctrl-C, a crash or a full disk\n"
     "  rockfold resume slope.vtkhdf --set analysis.end_time=20\n"
     "      to another end\n"},
    {Command::sweep, "sweep", "SWEEP.toml", "many runs of a model with varied parameters",
     "Runs a model with each combination of the values listed, or with values drawn (Latin\n"
     "hypercube, Monte Carlo), several runs at a time. Gathers results in DIR/sweep.csv and\n"
     "DIR/sweep.h5 and tells their spread, the probability of events and what they depend on.\n"
     "A run that fails is named and does not hurt the others. Started again it goes on.\n",
     "  rockfold sweep friction.toml -o friction\n"
     "      runs what is not done yet; exit status 1 if some runs failed\n"},
    {Command::view, "view", "OUT.vtkhdf", "a result as one page to look at in a browser",
     "Writes what a result file holds as one HTML page: blocks and joints in three dimensions, key "
     "blocks,\n"
     "states, monitors and energies. The page needs no network and no other file: double-click it, "
     "or\n"
     "send it to someone.\n",
     "  rockfold view slope.vtkhdf\n"
     "      writes slope.html\n"
     "  rockfold view slope.vtkhdf --every 10 -o /tmp/slope.html\n"
     "      with each tenth of the stored states\n"},
    {Command::report, "report", "OUT.vtkhdf", "a result as one document to print",
     "Writes what a result file holds as one HTML document for A4 paper: model, joints with their "
     "stereonet,\n"
     "views, key blocks, support design, classification, monitors and energies, assumptions, the "
     "model's\n"
     "text. It needs no network and no other file: open it in a browser and print it.\n",
     "  rockfold report slope.vtkhdf\n"
     "      writes slope.report.html\n"},
    {Command::info, "info", "OUT.vtkhdf", "what a result file holds",
     "Prints what made a result file and what it holds; with --json also its data sets and its "
     "model.\n",
     "  rockfold info slope.vtkhdf\n"},
    {Command::examples, "examples", "[NAME]",
     "list the example models; with a name, write it as NAME.toml",
     "Lists the example models that are part of the program. With a name, writes that model as "
     "NAME.toml\n"
     "and the files that it names to the current folder. A file that is there already is left "
     "alone, and\n"
     "nothing is written (exit status 3).\n",
     "  rockfold examples slope && rockfold run slope.toml\n"},
    {Command::serve, "serve", "", "answer one request after another, for other programs",
     "Reads requests from standard input, a line of JSON each: \"arguments\" as on a command line, "
     "the\n"
     "\"folder\" to work in, and what the command reads as its own \"input\". Answers each with a "
     "line\n"
     "{\"status\": 0, \"bytes\": 1234} and then so many bytes of its output. For many small "
     "questions:\n"
     "the program is loaded once.\n",
     "  rockfold serve < requests.jsonl\n"
     "      where a line is, say, {\"arguments\": [\"check\", \"slope.toml\", \"--json\"]}\n"},
}};

constexpr const char* common_options =
    "Common options, before or after the command:\n"
    "  --json                 one JSON document on stdout, nothing else there\n"
    "  -q, --quiet            no progress and no summary; warnings and errors stay\n"
    "  --threads N            threads to use; default: OMP_NUM_THREADS, or all there are\n"
    "  --seed N               each random joint set draws anew, by a seed of N and of its number\n"
    "  --max-time TIME        stop after that much time: seconds, \"10 min\", \"8 h\"; a run "
    "leaves a\n"
    "                         checkpoint for `rockfold resume` and prints what there is\n"
    "  --max-memory SIZE      likewise where the program needs more memory: \"4 GB\"\n"
    "  --json-file FILE       the document in a file, beside the summary\n"
    "  --log FILE             phases with their times, warnings and errors in a file too\n"
    "  --progress-fd N        how far each phase is, for other programs: JSON, a line each\n"
    "  --set KEY.PATH=VALUE   override a value of the model, e.g. cover.spacing=0.5 (repeatable);\n"
    "                         without a value, take the key or entry out: bolt_pattern.roof=\n"
    "  -y, --yes              cut a model into more than 100,000 blocks, knowingly\n"
    "  --ignore LOAD          a load that the command does not use, knowingly: traction, water, …\n"
    "  -h, --help             this text\n";

constexpr const char* standard_input =
    "MODEL.toml may be -, for standard input: files that it names lie in the current folder "
    "then.\n\n";

constexpr const char* output_option =
    "Options:\n"
    "  -o, --output OUT       result file; default: the model's path with .vtkhdf instead of "
    ".toml.\n"
    "                         An older file of that name is replaced when the new one is whole;\n"
    "                         OUT.xdmf beside it is for ParaView before 5.13.\n"
    "  --force                replace a result that holds states of a run by one without\n"
    "  --export FILE          the blocks for other programs, by the file's end (repeatable):\n"
    "                         .vtp (VTK), .obj, .stl, .3ddat (3DEC commands), .json\n";

constexpr const char* table_option =
    "  --table FILE           all key blocks as CSV, where the summary has the first twenty\n";

constexpr const char* certificate_option =
    "  --certificate FILE     what proves the factor: forces and velocities, for `rockfold "
    "verify`\n";

constexpr const char* no_result_option =
    "  --no-result            write no result file: the answer, exports, drawings and tables "
    "alone\n";

constexpr const char* with_report_option =
    "  --report               the printable report too (rockfold report), beside the result\n";

constexpr const char* view_options =
    "Options:\n"
    "  -o, --output OUT       the page; default: the result's path with .html instead of .vtkhdf\n"
    "  --every N              each N-th of the stored states, and the last\n"
    "  --surface-only         without the blocks that joints surround on all sides\n\n";

constexpr const char* report_options =
    "Options:\n"
    "  -o, --output OUT       the report; default: the result's path with .report.html instead of "
    ".vtkhdf\n\n";

constexpr const char* sweep_options =
    "Options:\n"
    "  -o, --output DIR       folder of the table and of what is under way; default: the sweep's\n"
    "                         path without .toml\n"
    "  --workers N            runs at a time; default: as the sweep says, or as many as cores\n"
    "  --slurm TASKS          compute nothing: write DIR/submit.sh, which gives the sweep to Slurm "
    "as\n"
    "                         a job array\n"
    "  --part I/N             compute each N-th run from the I-th on, without a table\n"
    "  --report               DIR/sweep.html too: the table, histograms, what results depend on\n"
    "  --gather               the table of what parts have computed\n"
    "  With several processes: mpirun -n 8 rockfold sweep SWEEP.toml\n\n";

constexpr const char* check_options =
    "Options:\n"
    "  --estimate             what memory and time `rockfold run` will take (or support, or cut), "
    "by\n"
    "                         doing its beginning: all stages and the first steps\n\n";

constexpr const char* sets_options =
    "Options:\n"
    "  -o, --output FILE      the sets as a part of a model, FILE.toml\n"
    "  --picture FILE         a stereonet, FILE.svg: lower hemisphere, equal area\n"
    "  --scanline TREND/PLUNGE  of the line or borehole that crosses all joints, degrees\n"
    "  --blind-zone DEG       joints nearer to their line are weighed as at this angle; default "
    "15\n"
    "  --sets N               look for N sets among the poles, or with \"auto\" for as many as "
    "the\n"
    "                         poles tell of, whatever the table's column set says\n"
    "  --left-hand            planes dip to the left of their strikes\n\n";

constexpr const char* info_options =
    "Options:\n"
    "  --hashes               a hash of each state: equal for equal motions\n\n";

constexpr const char* program_end =
    "Exit status:\n"
    "  0  done                          3  a file could not be read or written\n"
    "  1  the analysis failed           130, 143  interrupted (SIGINT, SIGTERM)\n"
    "  2  the model or the command line is wrong\n\n"
    "Example:\n"
    "  rockfold examples slope && rockfold support slope.toml\n"
    "      write an example model, then find its key blocks\n\n"
    "More about a command: rockfold COMMAND --help, or rockfold help COMMAND\n";

}  // namespace

std::span<const CommandHelp> command_helps() {
  return helps;
}

const CommandHelp& command_help(Command command) {
  for (const auto& help : helps)
    if (help.command == command) return help;
  return helps.front();  // every command is in the list
}

bool takes_model(Command command) {
  return std::string_view(command_help(command).input) == "MODEL.toml";
}

bool writes_results(Command command) {
  return command == Command::demo || command == Command::cut || command == Command::support ||
         command == Command::stability || command == Command::run;
}

bool lists_keyblocks(Command command) {
  return writes_results(command) && command != Command::cut && command != Command::stability;
}

bool may_leave_result(Command command) {
  return writes_results(command) && command != Command::demo;
}

bool makes_report(Command command) {
  return command == Command::support || command == Command::run || command == Command::sweep;
}

std::string program_help() {
  std::string text =
      "Rockfold: a 3-D Numerical Manifold Method simulator for jointed rock.\n\n"
      "Usage: rockfold COMMAND [OPTIONS]\n\nCommands:\n";
  for (const auto& help : helps)
    text += fmt::format("  {:<20}  {}\n", fmt::format("{} {}", help.name, help.input), help.brief);
  return text + "\n" + common_options + "  -V, --version          version and commit\n\n" +
         program_end;
}

std::string command_help_text(const CommandHelp& help) {
  std::string text = fmt::format("Usage: rockfold {}{}{} [OPTIONS]\n\n{}\n", help.name,
                                 *help.input ? " " : "", help.input, help.text);
  if (takes_model(help.command)) text += standard_input;
  if (writes_results(help.command)) text += output_option;
  if (lists_keyblocks(help.command)) text += table_option;
  if (help.command == Command::stability) text += certificate_option;
  if (may_leave_result(help.command)) text += no_result_option;
  if (makes_report(help.command) && writes_results(help.command)) text += with_report_option;
  if (writes_results(help.command)) text += "\n";
  if (help.command == Command::view) text += view_options;
  if (help.command == Command::report) text += report_options;
  if (help.command == Command::sweep) text += sweep_options;
  if (help.command == Command::check) text += check_options;
  if (help.command == Command::info) text += info_options;
  if (help.command == Command::sets) text += sets_options;
  return text + common_options + "\nExample:\n" + help.example;
}

}  // namespace rockfold
