// The certificate as JSON comes back bit by bit; what is no certificate is refused with its key.
#include "src/report/documents/certificate_document.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "src/base/error.hpp"
#include "src/report/error_text.hpp"

namespace rockfold::test {
namespace {

using Json = nlohmann::ordered_json;

/// Two bodies, two contacts and a bolt, of numbers that have no short decimal.
Certificate odd_certificate() {
  const Real tiny = std::numeric_limits<Real>::denorm_min();
  const Real huge = std::numeric_limits<Real>::max();
  Certificate c;
  c.mass.bodies = {{11, {0.1, 1.0 / 3, -0.0}, {tiny, huge, -huge}, {1e-300, 2, 3}},
                   {0, {4, 5, 6}, {7, 8, 9}, {std::sqrt(2), 0, 0}}};
  c.mass.contacts = {
      {{0, none}, {0, 0, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.7, 0, 0, "J1"},
      {{1, 0}, {1, 0, 0}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.1, 1e5 / 3, 1e4 / 3, "\u00e4\"\n"}};
  c.mass.ties = {{{none, 1}, {0.1, 0.2, 0.3}, {0, 0, 1}, 1.0 / 3, 1e5 / 3, "b.1"}};
  c.below = {1.1, std::vector<Vec3>(9, {std::nextafter(1.0, 2), 0.3, 0.1 + 0.2}), {1e5 / 3}};
  c.above = {1.3, {{{1, 2, 3}, {4, 5, 6}}, {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}}};
  c.sliding_balance = {1.2, std::vector<Vec3>(9, {-1, 1e22, 123456789.123456789}), {-0.0}};
  c.sliding_mechanism = {1.2, {{{6, 5, 4}, {3, 2, 1}}, {}}};
  return c;
}

void expect_same(const Mechanism& a, const Mechanism& b) {
  EXPECT_EQ(a.factor, b.factor);
  ASSERT_EQ(a.velocity.size(), b.velocity.size());
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    EXPECT_EQ(a.velocity[i].velocity, b.velocity[i].velocity);
    EXPECT_EQ(a.velocity[i].spin, b.velocity[i].spin);
  }
}

void expect_same(const Certificate& a, const Certificate& b) {
  ASSERT_EQ(a.mass.bodies.size(), b.mass.bodies.size());
  for (std::size_t i = 0; i < a.mass.bodies.size(); ++i) {
    const RigidBody6 &p = a.mass.bodies[i], &q = b.mass.bodies[i];
    EXPECT_EQ(p.block, q.block);
    EXPECT_EQ(p.centre, q.centre);
    EXPECT_EQ(p.force, q.force);
    EXPECT_EQ(p.moment, q.moment);
  }
  ASSERT_EQ(a.mass.contacts.size(), b.mass.contacts.size());
  for (std::size_t i = 0; i < a.mass.contacts.size(); ++i) {
    const ContactArea &p = a.mass.contacts[i], &q = b.mass.contacts[i];
    EXPECT_EQ(p.body, q.body);
    EXPECT_EQ(p.normal, q.normal);
    EXPECT_EQ(p.corner, q.corner);
    EXPECT_EQ(p.joint, q.joint);
    EXPECT_EQ((Vec3{p.friction, p.cohesion, p.tension}), (Vec3{q.friction, q.cohesion, q.tension}));
  }
  ASSERT_EQ(a.mass.ties.size(), b.mass.ties.size());
  for (std::size_t i = 0; i < a.mass.ties.size(); ++i) {
    const BoltTie &p = a.mass.ties[i], &q = b.mass.ties[i];
    EXPECT_EQ(p.body, q.body);
    EXPECT_EQ(p.at, q.at);
    EXPECT_EQ(p.axis, q.axis);
    EXPECT_EQ(p.least, q.least);
    EXPECT_EQ(p.most, q.most);
    EXPECT_EQ(p.bolt, q.bolt);
  }
  EXPECT_EQ(a.below.tension, b.below.tension);
  EXPECT_EQ(a.sliding_balance.tension, b.sliding_balance.tension);
  EXPECT_EQ(a.below.factor, b.below.factor);
  EXPECT_EQ(a.below.force, b.below.force);
  EXPECT_EQ(a.sliding_balance.factor, b.sliding_balance.factor);
  EXPECT_EQ(a.sliding_balance.force, b.sliding_balance.force);
  expect_same(a.above, b.above);
  expect_same(a.sliding_mechanism, b.sliding_mechanism);
}

TEST(CertificateDocument, ComesBackBitByBit) {
  const Certificate before = odd_certificate();
  const Certificate after = certificate_from(certificate_document(before).dump(), "odd.json");
  expect_same(before, after);
  EXPECT_TRUE(std::signbit(after.mass.bodies[0].centre[2]));
}

TEST(CertificateDocument, ComesBackWithoutSliding) {
  Certificate before = odd_certificate();
  before.sliding_balance = {};
  before.sliding_mechanism = {};
  const Json document = certificate_document(before);
  EXPECT_TRUE(document["sliding"].is_null());
  expect_same(before, certificate_from(document.dump(), "odd.json"));
}

TEST(CertificateDocument, ComesBackWithoutABoundFromAbove) {
  Certificate before = odd_certificate();
  before.above = {};
  const Json document = certificate_document(before);
  EXPECT_TRUE(document["bound"]["above"].is_null());
  expect_same(before, certificate_from(document.dump(), "odd.json"));
}

TEST(CertificateDocument, CountsFromOne) {
  const Json document = certificate_document(odd_certificate());
  EXPECT_EQ(document["rockfold"], "certificate/1");
  EXPECT_EQ(document["bodies"][0]["block"], 12);
  EXPECT_EQ(document["contacts"][0]["bodies"], Json::array({1, 0}));
  EXPECT_EQ(document["contacts"][1]["bodies"], Json::array({2, 1}));
  EXPECT_EQ(document["bound"]["above"]["velocities"][0], Json::array({1., 2., 3., 4., 5., 6.}));
}

TEST(CertificateDocument, WholeNumbersAreNumbers) {
  Json document = certificate_document(odd_certificate());
  document["contacts"][0]["normal"] = {0, 0, 1};
  document["contacts"][0]["friction"] = 1;
  const Certificate read = certificate_from(document.dump(), "odd.json");
  EXPECT_EQ(read.mass.contacts[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(read.mass.contacts[0].friction, 1);
}

std::string refusal(const std::string& text) {
  try {
    certificate_from(text, "c.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    return diagnostic_line(error.diagnostics().front());
  }
  return "nothing";
}

TEST(CertificateDocument, RefusesWhatIsNoCertificate) {
  EXPECT_EQ(refusal(""), "c.json: is no JSON document");
  EXPECT_EQ(refusal("{"), "c.json: is no JSON document");
  EXPECT_EQ(refusal("{\"rockfold\": 1e999}"), "c.json: is no JSON document");
  EXPECT_EQ(refusal("\xff\xfe"), "c.json: is no JSON document");
  EXPECT_EQ(refusal(std::string(100000, '[')), "c.json: is no JSON document");
  const std::string no_certificate =
      "c.json: is no certificate: \"rockfold\": \"certificate/1\" is missing";
  for (const char* text : {"null", "[]", "7", "\"certificate/1\"", "{}", R"({"rockfold": 1})",
                           R"({"rockfold": null})", R"({"rockfold": "certificate/2"})"})
    EXPECT_EQ(refusal(text), no_certificate) << text;
  EXPECT_EQ(refusal(std::string(100000, '[') + std::string(100000, ']')), no_certificate);
}

struct Malformed {
  const char* line;
  std::function<void(Json&)> spoil;
};

TEST(CertificateDocument, NamesTheKeyThatIsWrong) {
  const Malformed cases[] = {
      {"bodies: is missing", [](Json& d) { d.erase("bodies"); }},
      {"contacts: a list is wanted", [](Json& d) { d["contacts"] = 3; }},
      {"sliding: is missing", [](Json& d) { d.erase("sliding"); }},
      {"bound.below: is missing", [](Json& d) { d["bound"].erase("below"); }},
      {"bound: an object is wanted", [](Json& d) { d["bound"] = "both"; }},
      {"bodies[1]: an object is wanted", [](Json& d) { d["bodies"][0] = nullptr; }},
      {"bodies[2].block: a whole number from 1 up is wanted",
       [](Json& d) { d["bodies"][1]["block"] = 0; }},
      {"bodies[1].block: a whole number from 1 up is wanted",
       [](Json& d) { d["bodies"][0]["block"] = 1.5; }},
      {"bodies[1].block: a whole number from 1 up is wanted",
       [](Json& d) { d["bodies"][0]["block"] = 9223372036854775808u; }},
      {"bodies[1].block: a whole number from 1 up is wanted",
       [](Json& d) { d["bodies"][0]["block"] = 2147483648; }},
      {"bodies[2].moment: is missing", [](Json& d) { d["bodies"][1].erase("moment"); }},
      {"bodies[1].centre: three numbers are wanted",
       [](Json& d) {
         d["bodies"][0]["centre"] = {1, 2};
       }},
      {"bodies[1].force: three numbers are wanted",
       [](Json& d) {
         d["bodies"][0]["force"] = {1, 2, "3"};
       }},
      {"contacts[1].bodies: two bodies are wanted",
       [](Json& d) { d["contacts"][0]["bodies"] = {1}; }},
      {"contacts[1].bodies[2]: a whole number from 0 up is wanted",
       [](Json& d) { d["contacts"][0]["bodies"][1] = -1; }},
      {"contacts[2].bodies: a list is wanted",
       [](Json& d) {
         d["contacts"][1]["bodies"] = {{"a", 1}};
       }},
      {"contacts[2].normal: three numbers are wanted",
       [](Json& d) {
         d["contacts"][1]["normal"] = {1, 0, nullptr};
       }},
      {"contacts[2].corners[3]: three numbers are wanted",
       [](Json& d) {
         d["contacts"][1]["corners"][2] = {1, 0, 0, 0};
       }},
      {"contacts[1].friction: a number is wanted",
       [](Json& d) { d["contacts"][0]["friction"] = "0.7"; }},
      {"contacts[1].tension: a number is wanted",
       [](Json& d) { d["contacts"][0]["tension"] = true; }},
      {"contacts[1].joint: a text is wanted", [](Json& d) { d["contacts"][0]["joint"] = 1; }},
      {"bound.below.factor: a number is wanted",
       [](Json& d) { d["bound"]["below"]["factor"] = nullptr; }},
      {"bound.below.forces[9]: three numbers are wanted",
       [](Json& d) { d["bound"]["below"]["forces"][8] = 0; }},
      {"bound.above.velocities[1]: six numbers are wanted",
       [](Json& d) {
         d["bound"]["above"]["velocities"][0] = {1, 2, 3};
       }},
      {"sliding: an object is wanted", [](Json& d) { d["sliding"] = false; }},
      {"sliding.forces: is missing", [](Json& d) { d["sliding"].erase("forces"); }},
      {"sliding.velocities: is empty; where there is no sliding, null is wanted",
       [](Json& d) { d["sliding"]["velocities"] = Json::array(); }},
  };
  for (const Malformed& malformed : cases) {
    Json document = certificate_document(odd_certificate());
    malformed.spoil(document);
    EXPECT_EQ(refusal(document.dump()), std::string("c.json: ") + malformed.line);
  }
}

/// Each value of the document replaced by one of another kind: refused or taken, never more.
TEST(CertificateDocument, TakesOrRefusesAnyJson) {
  const Json whole = certificate_document(odd_certificate());
  const Json flat = whole.flatten();
  for (const Json& other :
       {Json(), Json(-1), Json(1e308), Json("x"), Json::array(), Json::object(), Json({{1}, {2}})})
    for (const auto& [path, value] : flat.items()) {
      const Json::json_pointer last(path);
      for (Json::json_pointer at = last; !at.empty(); at = at.parent_pointer()) {
        Json document = whole;
        document[at] = other;
        refusal(document.dump());
      }
    }
}

TEST(CertificateDocument, TellsOfAFileThatIsNotThere) {
  EXPECT_THROW(read_certificate("no/such/certificate.json"), Error);
}

}  // namespace
}  // namespace rockfold::test
