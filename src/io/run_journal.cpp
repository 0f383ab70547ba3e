#include "src/io/run_journal.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "src/base/archive.hpp"
#include "src/base/error.hpp"
#include "src/io/partial_file.hpp"

namespace rockfold {
namespace {

constexpr char journal_mark[8] = {'R', 'F', 'J', 'R', 'N', 'L', '0', '1'};
constexpr char checkpoint_mark[8] = {'R', 'F', 'C', 'H', 'K', 'P', '0', '1'};
constexpr std::uint64_t origin_record = 1, state_record = 2;

/// In front of each record.
struct RecordHead {
  std::uint64_t kind, length, hash;
};
/// In front of a state's bytes.
struct StateHead {
  std::int64_t step;
  Real time;
  std::uint64_t hash;
};
struct CheckpointHead {
  char mark[8];
  std::uint64_t journal, length, hash;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
}
[[noreturn]] void fail_with_reason(const std::string& path, const char* what) {
  fail(path, std::string(what) + ": " + std::strerror(errno));
}

void pass(Archive& archive, RunOrigin& origin) {
  archive.all(origin.version, origin.commit, origin.command, origin.model, origin.folder,
              origin.text, origin.overrides, origin.ignored, origin.exports, origin.table,
              origin.report, origin.seed);
  auto count = static_cast<std::uint64_t>(origin.inputs.size());
  archive.pass(count);
  origin.inputs.resize(std::min<std::uint64_t>(count, 1 << 20));
  for (RunOrigin::Input& input : origin.inputs) archive.all(input.path, input.bytes, input.hash);
  if (archive.packs() || !archive.at_end())
    archive.pass(origin.search);  // results of runs may have none
}

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  return Hash().add(bytes).value();
}

/// All of `bytes`, at `offset`; signals and short writes are gone on from. Whether it was done.
bool write_all(int file, std::span<const std::byte> bytes, std::int64_t offset) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(file, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += written;
  }
  return true;
}

std::vector<std::byte> read_bytes(std::ifstream& in, std::uint64_t length) {
  std::vector<std::byte> bytes(length);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(length));
  if (!in) bytes.clear();
  return bytes;
}

template <typename Head>
std::span<const std::byte> bytes_of(const Head& head) {
  return std::as_bytes(std::span(&head, 1));
}

std::optional<std::vector<std::byte>> read_checkpoint(const std::string& path,
                                                      std::uint64_t journal) {
  std::ifstream in(path, std::ios::binary);
  CheckpointHead head{};
  if (!in.read(reinterpret_cast<char*>(&head), sizeof head)) return {};
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  // Of another run, or of none: as if it were not there.
  if (std::memcmp(head.mark, checkpoint_mark, sizeof head.mark) != 0 || head.journal != journal ||
      error || head.length != size - sizeof head)
    return {};
  std::vector<std::byte> bytes = read_bytes(in, head.length);
  if (hash_of(bytes) != head.hash) fail(path, "is damaged: its bytes do not give their hash");
  return bytes;
}

/// What killed programs left half-written of this result; its journal is ours, so nobody writes them any more.
void remove_leftovers(const std::string& result) {
  const std::filesystem::path path(result);
  const std::string file = path.filename().string(), own = std::to_string(getpid());
  std::error_code ignored;
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    for (std::string of : {file, checkpoint_path(file)}) {
      of += ".partial-";
      if (name.starts_with(of) && name.substr(of.size()) != own)
        std::filesystem::remove(entry.path(), ignored);
    }
  }
}

}  // namespace

std::vector<std::byte> packed(const RunOrigin& origin) {
  Archive archive;
  RunOrigin copy = origin;
  pass(archive, copy);
  return std::move(archive.bytes());
}

RunOrigin unpacked_origin(std::span<const std::byte> bytes) {
  Archive archive(bytes);
  RunOrigin origin;
  pass(archive, origin);
  return origin;
}

RunOrigin::Input fingerprint(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_with_reason(path, "cannot be read");
  RunOrigin::Input input{path, 0, 0};
  Hash hash;
  std::vector<char> chunk(std::size_t{1} << 20);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || in.gcount() > 0) {
    const auto length = static_cast<std::size_t>(in.gcount());
    hash.add(std::as_bytes(std::span(chunk.data(), length)));
    input.bytes += length;
  }
  input.hash = hash.value();
  return input;
}

std::string journal_path(const std::string& result) {
  return result + ".journal";
}
std::string checkpoint_path(const std::string& result) {
  return result + ".checkpoint";
}

std::optional<JournalContents> read_journal(const std::string& result) {
  const std::string path = journal_path(result);
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  char mark[sizeof journal_mark] = {};
  if (!in.read(mark, sizeof mark)) return {};  // killed before it said anything
  if (std::memcmp(mark, journal_mark, sizeof mark) != 0)
    fail(path, "is no journal of a run of this version");
  JournalContents contents;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  std::int64_t at = sizeof mark;
  std::uint64_t name = 0;
  RecordHead head{};
  while (in.read(reinterpret_cast<char*>(&head), sizeof head)) {
    const auto begin = at + static_cast<std::int64_t>(sizeof head);
    if (head.length > static_cast<std::uint64_t>(size - begin)) break;
    const std::vector<std::byte> bytes = read_bytes(in, head.length);
    if (hash_of(bytes) != head.hash) break;
    if (head.kind == origin_record) {
      contents.origin = unpacked_origin(bytes);
      name = head.hash;
    } else if (head.kind == state_record && bytes.size() >= sizeof(StateHead)) {
      StateHead state{};
      std::memcpy(&state, bytes.data(), sizeof state);
      contents.states.push_back({static_cast<Index>(state.step), state.time, state.hash,
                                 begin + static_cast<std::int64_t>(sizeof state),
                                 static_cast<std::int64_t>(head.length - sizeof state)});
    }
    at = begin + static_cast<std::int64_t>(head.length);
  }
  if (name == 0) return {};
  contents.end = at;
  contents.checkpoint = read_checkpoint(checkpoint_path(result), name);
  return contents;
}

std::vector<std::byte> read_state(const std::string& result, const JournalState& state) {
  std::ifstream in(journal_path(result), std::ios::binary);
  in.seekg(state.begin);
  std::vector<std::byte> bytes = read_bytes(in, static_cast<std::uint64_t>(state.length));
  if (bytes.empty()) fail(journal_path(result), "cannot be read");
  return bytes;
}

void RunJournal::open(int flags) {
  const std::string path = journal_path(result_);
  file_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC | flags, 0666);
  if (file_ < 0) fail_with_reason(path, "cannot be written");
  // Some network file systems have no locks: there nobody watches over two runs of one name.
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(file_);
    file_ = -1;
    fail(path,
         "belongs to a run that is still under way: wait for it, or name another result with -o");
  }
  remove_leftovers(result_);
}

RunJournal::RunJournal(std::string result, const RunOrigin& origin) : result_(std::move(result)) {
  open(O_CREAT);
  std::remove(checkpoint_path(result_).c_str());
  const std::vector<std::byte> first = packed(origin);
  if (ftruncate(file_, 0) != 0 || !write_all(file_, bytes_of(journal_mark), 0))
    fail_with_reason(journal_path(result_), "cannot be written");
  end_ = sizeof journal_mark;
  append(origin_record, first);
  name_ = hash_of(first);
}

RunJournal::RunJournal(std::string result, const JournalContents& contents, std::size_t states)
    : result_(std::move(result)) {
  open(0);
  name_ = hash_of(packed(contents.origin));
  end_ = states < contents.states.size()
             ? contents.states[states].begin -
                   static_cast<std::int64_t>(sizeof(StateHead) + sizeof(RecordHead))
             : contents.end;
  if (ftruncate(file_, end_) != 0) fail_with_reason(journal_path(result_), "cannot be written");
}

RunJournal::~RunJournal() {
  if (file_ >= 0) close(file_);
}

/// A record that does not fit on the disk is taken back.
void RunJournal::append(std::uint64_t kind, std::span<const std::byte> bytes) {
  const SignalsWait until_it_is_written;
  const RecordHead head{kind, bytes.size(), hash_of(bytes)};
  const auto begin = end_ + static_cast<std::int64_t>(sizeof head);
  if (!write_all(file_, bytes, begin) || !write_all(file_, bytes_of(head), end_)) {
    const int why = errno;
    [[maybe_unused]] const int ignored = ftruncate(file_, end_);
    fail(journal_path(result_), std::string("cannot write: ") + std::strerror(why));
  }
  end_ = begin + static_cast<std::int64_t>(bytes.size());
}

void RunJournal::add_state(Index step, Real time, std::uint64_t hash,
                           std::span<const std::byte> bytes) {
  const StateHead head{step, time, hash};
  std::vector<std::byte> record(sizeof head + bytes.size());
  std::memcpy(record.data(), &head, sizeof head);
  std::memcpy(record.data() + sizeof head, bytes.data(), bytes.size());
  append(state_record, record);
}

void RunJournal::save_checkpoint(std::span<const std::byte> bytes) {
  const std::string path = checkpoint_path(result_);
  CheckpointHead head{{}, name_, bytes.size(), hash_of(bytes)};
  std::memcpy(head.mark, checkpoint_mark, sizeof head.mark);
  if (fdatasync(file_) != 0) fail_with_reason(journal_path(result_), "cannot write");
  PartialFile target(path);
  const int file = ::open(target.aside().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool written = file >= 0 && write_all(file, bytes_of(head), 0) &&
                       write_all(file, bytes, sizeof head) && fdatasync(file) == 0;
  const int why = errno;
  if (file >= 0) close(file);
  if (!written) fail(path, std::string("cannot write: ") + std::strerror(why));
  target.take_name();
}

void RunJournal::remove() {
  std::remove(journal_path(result_).c_str());
  std::remove(checkpoint_path(result_).c_str());
}

}  // namespace rockfold
