#include "src/model/text/nearest.hpp"

#include <algorithm>

namespace rockfold {

namespace {

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Optimal string alignment distance (Boytsov 2011, "restricted Damerau–Levenshtein"), O(|a|·|b|).
std::size_t distance(const std::string& a, const std::string& b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      auto& here = d[i * width + j];
      if (i == 0 || j == 0) {
        here = i + j;
        continue;
      }
      const std::size_t replaced = d[(i - 1) * width + j - 1] + (a[i - 1] != b[j - 1]);
      here = std::min({replaced, d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        here = std::min(here, d[(i - 2) * width + j - 2] + 1);
    }
  }
  return d.back();
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 60;  // nobody means a key by more letters; bounds the cost
  if (word.size() > longest) return "";
  const std::string typed = lower_case(word);
  std::string nearest;
  std::size_t best = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const auto d = distance(typed, lower_case(candidate));
    if (d < best && d < candidate.size()) {
      best = d;
      nearest = candidate;
    }
  }
  if (!nearest.empty() || typed.size() < 3) return nearest;
  const auto is_begin = [&](const auto& c) { return lower_case(c).rfind(typed, 0) == 0; };
  const auto is_part = [&](const auto& c) {
    return ("_" + lower_case(c) + "_").find("_" + typed + "_") != std::string::npos;
  };
  auto full = std::find_if(candidates.begin(), candidates.end(), is_begin);
  if (full == candidates.end()) full = std::find_if(candidates.begin(), candidates.end(), is_part);
  return full == candidates.end() ? "" : *full;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view these) {
  if (candidates.empty()) return "";
  const auto nearest = nearest_word(word, candidates);
  if (!nearest.empty()) return ", did you mean \"" + nearest + "\"?";
  constexpr std::size_t most = 20;
  std::string list = "; " + std::string(these) + ": ";
  for (std::size_t i = 0; i < std::min(candidates.size(), most); ++i)
    list += (i ? ", " : "") + candidates[i];
  return candidates.size() > most ? list + ", …" : list;
}

}  // namespace rockfold
