// One request after another from standard input, for programs that ask many small questions: a child of this process answers each, so that
// nothing has to be loaded anew, and nothing of one answer is left for the next.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rockfold {

/// A request is a line of JSON: {"arguments": ["support", "-", "--json"], "folder": "/work", "input": "the text of a model"}; the last two
/// may be missing. The answer is a line {"status": 0, "bytes": 1234}, where `status` is the exit status, and then so many bytes: what the
/// command wrote to standard output. Ends with the input. A line that is no request is answered with status 2 and no bytes.
/// `run`: the program, given its command line; returns its exit status.
int serve_requests(const std::function<int(const std::vector<std::string>&)>& run);

}  // namespace rockfold
