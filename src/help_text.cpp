#include "src/help_text.hpp"

#include <array>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr std::array<CommandHelp, 8> helps{{
    {Command::demo, "demo", "", "the built-in rock slope: blocks, key blocks, response to gravity",
     "Takes a jointed rock slope that is part of the program through all stages: blocks, key "
     "blocks with\n"
     "their support, one second of its response to gravity. The result file is "
     "rockfold_demo.vtkhdf in\n"
     "the current folder, unless -o names another.\n",
     "  rockfold demo\n"
     "      prints a summary; open rockfold_demo.vtkhdf in ParaView\n"},
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
    {Command::run, "run", "MODEL.toml", "covers and analysis; support too where [support] stands",
     "Cuts the rock, lays covers over it and carries out the model's [analysis]; finds key blocks "
     "too\n"
     "where the model has a [support] table. Ctrl-C ends it at the last step done,\n"
     "keeps the states so far and exits with status 130; a second Ctrl-C exits at once.\n",
     "  rockfold run slope.toml -o /tmp/slope.vtkhdf --threads 2\n"
     "      states every output.every steps go to /tmp/slope.vtkhdf\n"},
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
}};

constexpr const char* common_options =
    "Common options, before or after the command:\n"
    "  --json                 one JSON document on stdout, nothing else there\n"
    "  -q, --quiet            no progress and no summary; warnings and errors stay\n"
    "  --threads N            threads to use; default: OMP_NUM_THREADS, or all there are\n"
    "  --seed N               seed of the first joint set where random; the next has N + 1, …\n"
    "  --set KEY.PATH=VALUE   override a value of the model, e.g. cover.spacing=0.5 (repeatable)\n"
    "  -h, --help             this text\n";

constexpr const char* output_option =
    "Options:\n"
    "  -o, --output OUT       result file; default: the model's path with .vtkhdf instead of "
    ".toml.\n"
    "                         An older file of that name is replaced when the new one is whole;\n"
    "                         OUT.xdmf beside it is for ParaView before 5.13.\n"
    "  --export FILE          the blocks for other programs, by the file's end (repeatable):\n"
    "                         .vtp (VTK), .obj, .stl, .3ddat (3DEC commands), .json\n\n";

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

bool writes_results(Command command) {
  return command == Command::demo || command == Command::cut || command == Command::support ||
         command == Command::run;
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
  if (writes_results(help.command)) text += output_option;
  return text + common_options + "\nExample:\n" + help.example;
}

}  // namespace rockfold
