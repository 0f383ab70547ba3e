#include "src/report/documents/certificate_document.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/files/data_file.hpp"
#include "src/base/error.hpp"

namespace rockfold {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "certificate/1";
constexpr std::size_t velocity_numbers = 6;  // of a centre, and the spin
constexpr std::size_t body_pair = 2;

Json body_json(const RigidBody6& body) {
  return {{"block", static_cast<std::int64_t>(body.block) + 1},
          {"centre", body.centre},
          {"force", body.force},
          {"moment", body.moment}};
}

/// Held rock, none, is 0.
Json contact_json(const ContactArea& area) {
  const auto number = [](Index body) { return static_cast<std::int64_t>(body) + 1; };
  return {{"bodies", {number(area.body[0]), number(area.body[1])}},
          {"joint", area.joint},
          {"normal", area.normal},
          {"corners", area.corner},
          {"friction", area.friction},
          {"cohesion", area.cohesion},
          {"tension", area.tension}};
}

Json tie_json(const BoltTie& tie) {
  const auto number = [](Index body) { return static_cast<std::int64_t>(body) + 1; };
  return {{"bodies", {number(tie.body[0]), number(tie.body[1])}},
          {"bolt", tie.bolt},
          {"at", tie.at},
          {"axis", tie.axis},
          {"least", tie.least},
          {"most", tie.most}};
}

Json velocities_json(const Mechanism& mechanism) {
  Json list = Json::array();
  for (const auto& [v, w] : mechanism.velocity)
    list.push_back({v[0], v[1], v[2], w[0], w[1], w[2]});
  return list;
}

template <class Entry>
Json list_json(const std::vector<Entry>& entries, Json (*entry_json)(const Entry&)) {
  Json list = Json::array();
  for (const Entry& entry : entries) list.push_back(entry_json(entry));
  return list;
}

/// A value of a document and its place, "contacts[3].normal".
class Reader {
 public:
  Reader(const Json& value, std::string file, std::string key = "")
      : value_(value), file_(std::move(file)), key_(std::move(key)) {}

  Reader at(const std::string& key) const {
    if (!value_.is_object()) fail("an object is wanted");
    const std::string path = key_.empty() ? key : key_ + "." + key;
    const auto found = value_.find(key);
    if (found == value_.end()) Reader(value_, file_, path).fail("is missing");
    return {*found, file_, path};
  }

  bool is_null() const { return value_.is_null(); }

  /// The entries of a list that may be missing.
  std::vector<Reader> list_if_any(const std::string& key) const {
    return value_.is_object() && !value_.contains(key) ? std::vector<Reader>{} : at(key).list();
  }

  Real number() const {
    if (!value_.is_number()) fail("a number is wanted");
    return value_.get<Real>();
  }

  /// Counted from `least` on; one less is returned.
  Index id(Index least) const {
    const bool fits = value_.is_number_integer() &&
                      (!value_.is_number_unsigned() ||
                       value_.get<std::uint64_t>() <= std::numeric_limits<Index>::max());
    if (!fits || value_.get<std::int64_t>() < least)
      fail(fmt::format("a whole number from {} up is wanted", least));
    return static_cast<Index>(value_.get<std::int64_t>() - 1);
  }

  std::string text() const {
    if (!value_.is_string()) fail("a text is wanted");
    return value_.get<std::string>();
  }

  std::vector<Reader> list() const {
    if (!value_.is_array()) fail("a list is wanted");
    std::vector<Reader> entries;
    for (std::size_t i = 0; i < value_.size(); ++i)
      entries.emplace_back(value_[i], file_, fmt::format("{}[{}]", key_, i + 1));
    return entries;
  }

  template <std::size_t count>
  std::array<Real, count> numbers(const char* wanted) const {
    const auto is_number = [](const Json& x) { return x.is_number(); };
    if (!value_.is_array() || value_.size() != count ||
        !std::all_of(value_.begin(), value_.end(), is_number))
      fail(fmt::format("{} numbers are wanted", wanted));
    return value_.get<std::array<Real, count>>();
  }

  Vec3 vector() const { return numbers<3>("three"); }

  std::vector<Vec3> vectors() const {
    std::vector<Vec3> result;
    for (const Reader& entry : list()) result.push_back(entry.vector());
    return result;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::io, what, Place{file_, 0, 0, key_});
  }

 private:
  const Json& value_;
  std::string file_, key_;
};

RigidBody6 body_from(const Reader& in) {
  return {in.at("block").id(1), in.at("centre").vector(), in.at("force").vector(),
          in.at("moment").vector()};
}

std::array<Index, 2> pair_from(const Reader& in) {
  const std::vector<Reader> bodies = in.list();
  if (bodies.size() != body_pair) in.fail("two bodies are wanted");
  return {bodies[0].id(0), bodies[1].id(0)};
}

ContactArea contact_from(const Reader& in) {
  return {pair_from(in.at("bodies")), in.at("normal").vector(),   in.at("corners").vectors(),
          in.at("friction").number(), in.at("cohesion").number(), in.at("tension").number(),
          in.at("joint").text()};
}

BoltTie tie_from(const Reader& in) {
  return {pair_from(in.at("bodies")), in.at("at").vector(),   in.at("axis").vector(),
          in.at("least").number(),    in.at("most").number(), in.at("bolt").text()};
}

Balance balance_from(const Reader& in) {
  Balance balance{in.at("factor").number(), in.at("forces").vectors(), {}};
  for (const Reader& tension : in.list_if_any("tensions"))
    balance.tension.push_back(tension.number());
  return balance;
}

Mechanism mechanism_from(const Reader& in) {
  Mechanism mechanism{in.at("factor").number(), {}};
  for (const Reader& entry : in.at("velocities").list()) {
    const auto v = entry.numbers<velocity_numbers>("six");
    mechanism.velocity.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
  }
  return mechanism;
}

}  // namespace

Json certificate_document(const Certificate& certificate) {
  Json document{{"rockfold", format_name}};
  document["bodies"] = list_json(certificate.mass.bodies, body_json);
  document["contacts"] = list_json(certificate.mass.contacts, contact_json);
  document["ties"] = list_json(certificate.mass.ties, tie_json);
  document["bound"]["below"] = {{"factor", certificate.below.factor},
                                {"forces", certificate.below.force},
                                {"tensions", certificate.below.tension}};
  document["bound"]["above"] = nullptr;
  if (!certificate.above.velocity.empty())
    document["bound"]["above"] = {{"factor", certificate.above.factor},
                                  {"velocities", velocities_json(certificate.above)}};
  document["sliding"] = nullptr;
  if (!certificate.sliding_mechanism.velocity.empty())
    document["sliding"] = {{"factor", certificate.sliding_balance.factor},
                           {"forces", certificate.sliding_balance.force},
                           {"tensions", certificate.sliding_balance.tension},
                           {"velocities", velocities_json(certificate.sliding_mechanism)}};
  return document;
}

Certificate certificate_from(const std::string& text, const std::string& file) {
  const Json document = Json::parse(text, nullptr, false);
  const Reader in(document, file);
  if (document.is_discarded()) in.fail("is no JSON document");
  if (!document.is_object() || document.value("rockfold", Json()) != format_name)
    in.fail(fmt::format("is no certificate: \"rockfold\": \"{}\" is missing", format_name));
  Certificate certificate;
  for (const Reader& body : in.at("bodies").list())
    certificate.mass.bodies.push_back(body_from(body));
  for (const Reader& contact : in.at("contacts").list())
    certificate.mass.contacts.push_back(contact_from(contact));
  for (const Reader& tie : in.list_if_any("ties")) certificate.mass.ties.push_back(tie_from(tie));
  certificate.below = balance_from(in.at("bound").at("below"));
  if (const Reader above = in.at("bound").at("above"); !above.is_null()) {
    certificate.above = mechanism_from(above);
    if (certificate.above.velocity.empty())
      above.at("velocities").fail("is empty; where there is no bound from above, null is wanted");
  }
  const Reader sliding = in.at("sliding");
  if (sliding.is_null()) return certificate;
  certificate.sliding_balance = balance_from(sliding);
  certificate.sliding_mechanism = mechanism_from(sliding);
  if (certificate.sliding_mechanism.velocity.empty())
    sliding.at("velocities").fail("is empty; where there is no sliding, null is wanted");
  return certificate;
}

Certificate read_certificate(const std::string& file) {
  const Place place{file, 0, 0, ""};
  std::error_code none_such;
  if (std::filesystem::is_regular_file(file, none_such) && std::filesystem::file_size(file) == 0)
    throw Error(ErrorKind::io, "is empty: it holds no certificate", place);
  return certificate_from(read_data_file(place), file);
}

}  // namespace rockfold
