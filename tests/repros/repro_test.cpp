#include "repros/repro.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::array all_forms = {ReproForm::cpp_plain,  ReproForm::cpp_embree,   ReproForm::cpp_cgal,
                                  ReproForm::cpp_bullet, ReproForm::cpp_glm,      ReproForm::js_three,
                                  ReproForm::c_librt,    ReproForm::python_proof, ReproForm::obj,
                                  ReproForm::ply,        ReproForm::asc};

constexpr double inf = std::numeric_limits<double>::infinity();

Case case_of(const Triangle& triangle, const Ray& ray, Precision precision = Precision::binary64) {
  Case c;
  c.id = "some-case";
  c.precision = precision;
  c.bag.triangles = {triangle};
  c.ray = ray;
  return c;
}

constexpr Triangle unit = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// Whether this build has whom the form asks (of c_librt and js_three the contract is told without).
bool possible(ReproForm form) {
  switch (form) {
    case ReproForm::cpp_embree: return tracer_named("embree_robust");
    case ReproForm::cpp_cgal: return tracer_named("cgal_cartesian_f64");
    case ReproForm::cpp_bullet: return tracer_named("bullet_f32");
    case ReproForm::cpp_glm: return tracer_named("glm_f32");
    default: return true;
  }
}

std::string error_of(const Case& c, ReproForm form, std::string_view tracer) {
  try {
    to_repro(c, form, tracer);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// What is left without lines that are comments in that form.
std::string code_of(const std::string& text, ReproForm form) {
  const std::string leader = form == ReproForm::ply ? "comment" : form < ReproForm::python_proof ? "//" : "#";
  std::istringstream lines(text);
  std::string code;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(leader)) code += line + '\n';
  return code;
}

TEST(ReproForm, OfATracer) {
  EXPECT_EQ(repro_form_of("embree_robust_avx2"), ReproForm::cpp_embree);
  EXPECT_EQ(repro_form_of("cgal_epick"), ReproForm::cpp_cgal);
  EXPECT_EQ(repro_form_of("bullet_f32"), ReproForm::cpp_bullet);
  EXPECT_EQ(repro_form_of("glm_f64"), ReproForm::cpp_glm);
  EXPECT_EQ(repro_form_of("brlcad_librt"), ReproForm::c_librt);
  EXPECT_EQ(repro_form_of("brlcad_bot_classic"), ReproForm::c_librt);
  EXPECT_EQ(repro_form_of("brlcad_bot_classic_kernel"), ReproForm::cpp_plain);
  EXPECT_EQ(repro_form_of("woop_watertight_f32"), ReproForm::cpp_plain);
  EXPECT_EQ(repro_form_of("./my.so"), ReproForm::cpp_plain);
  EXPECT_EQ(repro_form_of(""), ReproForm::cpp_plain);
}

TEST(ReproFileName, SaysTheLanguage) {
  EXPECT_EQ(repro_file_name(ReproForm::cpp_embree), "repro.cpp");
  EXPECT_EQ(repro_file_name(ReproForm::c_librt), "repro.c");
  EXPECT_EQ(repro_file_name(ReproForm::js_three), "repro.mjs");
  EXPECT_EQ(repro_file_name(ReproForm::python_proof), "proof.py");
  EXPECT_EQ(repro_file_name(ReproForm::asc), "scene.asc");
}

TEST(Repro, HoldsTheNumbersBitForBit) {
  const Triangle triangle = {
      {-0.0, 0x1.000002p+0, 0x1.fffffep-2}, {0x1.921fb6p+1, 0x1p-126, -0x1p+20}, {0x1.8p-149, 3, 0x1.5p+6}};
  const Ray ray = {{0x1.234568p+1, -0x1.fffffep+3, 7}, {0x1.000004p-3, 1, 0x1.abcdeep+1}, 0x1.99999ap-4, 0x1p+30};
  Case c = case_of(triangle, ray, Precision::binary32);
  c.bag.triangles.front().c.x = 0x1p-149;
  std::set<double> wanted;
  const Triangle& t = c.bag.triangles.front();
  for (const Vec3& v : {t.a, t.b, t.c, ray.origin, ray.direction})
    for (const double x : {v.x, v.y, v.z}) wanted.insert(x);
  for (const ReproForm form : all_forms) {
    if (!possible(form)) continue;
    // Bullet's segment isn't the ray, and scenes have none: there it stands in comments.
    const bool in_comments = form == ReproForm::cpp_bullet || form > ReproForm::python_proof;
    const std::string text = to_repro(c, form, ""), code = in_comments ? text : code_of(text, form);
    static const std::regex number(R"(-?0x[0-9a-f.]+p[-+]\d+|-?\d[0-9.]*(e[-+]\d+)?)");
    std::set<double> found;
    for (std::sregex_iterator at(code.begin(), code.end(), number), end; at != end; ++at)
      if (const auto x = parse_real(at->str())) found.insert(*x);
    for (const double x : wanted) EXPECT_TRUE(found.contains(x)) << name(form) << " lacks " << hexfloat(x);
  }
}

TEST(Repro, SignOfZeroStays) {
  const Case c = case_of({{-0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0.25, 0.25, 1}, {-0.0, 0, -1}});
  EXPECT_THAT(to_repro(c, ReproForm::cpp_plain, ""), HasSubstr("direction[3] = {-0x0p+0, 0x0p+0, -0x1p+0};"));
  EXPECT_THAT(to_repro(c, ReproForm::python_proof, ""), HasSubstr("A = exact(\"-0x0p+0\", \"0x0p+0\", \"0x0p+0\")"));
  EXPECT_THAT(to_repro(c, ReproForm::obj, ""), HasSubstr("v -0 0 0\n"));
  EXPECT_THAT(to_repro(c, ReproForm::js_three, ""), HasSubstr("new Vector3(-0, 0, -1)"));
}

TEST(Repro, TellsWhoIsWrongAndByHowMuch) {
  // README's: the ray passes 2^-51 outside.
  const Case c = case_of({{0, 0, 1}, {0, 0, -2 + 0x1p-51}, {1, 0, 0}}, {{0, 0, -2}, {0, 1, 0}});
  const std::string text = to_repro(c, ReproForm::cpp_plain, "moller_trumbore_f64");
  EXPECT_TRUE(
      text.starts_with("// moller_trumbore_f64 hits a triangle that the ray misses: a false hit by 1 ulps of the "
                       "largest coordinate.\n"));
  EXPECT_THAT(text, HasSubstr("// case       some-case\n"));
  EXPECT_THAT(text, HasSubstr("// call       Moller and Trumbore, Fast, Minimum Storage"));
  EXPECT_THAT(text, HasSubstr("exterior: a w has the sign against det: the line passes outside"));
  EXPECT_THAT(text, HasSubstr("1 ulps of the largest coordinate"));
  EXPECT_THAT(text, HasSubstr("// contract   binary64 inputs, edges closed, t range given"));
  EXPECT_THAT(text, HasSubstr("bool right = !got.hit;"));
}

TEST(Repro, TellsNobodyOffWhoIsRight) {
  const Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  const std::string text = to_repro(c, ReproForm::cpp_plain, "moller_trumbore_f64");
  EXPECT_TRUE(text.starts_with("// moller_trumbore_f64 gets this ray right.\n"));
  EXPECT_THAT(text, HasSubstr("is_near(\"t\", got.t, 0x1p+0, "));
  EXPECT_THAT(text, HasSubstr("is_near(\"u\", got.u, 0x1p-2, "));
}

TEST(Repro, WhereNothingIsPromisedEitherIsRight) {
  if (!possible(ReproForm::cpp_embree)) GTEST_SKIP() << "this build has no Embree";
  const Case edge = case_of(unit, {{0.5, 0, 1}, {0, 0, -1}});
  const std::string text = to_repro(edge, ReproForm::cpp_embree, "embree_default");
  EXPECT_THAT(text,
              AllOf(HasSubstr("bool right = true;"), HasSubstr("RTC_SCENE_FLAG_NONE"), HasSubstr("rtcIntersect1")));
}

TEST(Repro, FollowsTheTracersRules) {
  if (!possible(ReproForm::cpp_embree)) GTEST_SKIP() << "this build has no Embree";
  const Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}}, Precision::binary32);
  const auto embree = [&](const char* tracer) { return to_repro(c, ReproForm::cpp_embree, tracer); };
  EXPECT_THAT(embree("embree_robust_sse2"),
              AllOf(HasSubstr("threads=1,isa=sse2"), HasSubstr("RTC_SCENE_FLAG_ROBUST")));
  EXPECT_THAT(embree("embree_default_w8"),
              AllOf(HasSubstr("rtcIntersect8(valid, "), HasSubstr("struct RTCRayHit8 query")));
  EXPECT_THAT(embree("embree_robust_occluded"), AllOf(HasSubstr("rtcOccluded1"), Not(HasSubstr("is_near"))));
  EXPECT_THAT(embree("moller_trumbore_f32"), AllOf(HasSubstr("threads=1\""), HasSubstr("RTC_SCENE_FLAG_ROBUST")));
}

TEST(Repro, AProofNamesTheClass) {
  const auto proof = [](const Ray& ray, const Triangle& triangle = unit) {
    return to_repro(case_of(triangle, ray), ReproForm::python_proof, "");
  };
  EXPECT_THAT(proof({{0.25, 0.25, 1}, {0, 0, -1}}), HasSubstr("Truth: the ray crosses the interior."));
  EXPECT_THAT(proof({{0.25, 0, 1}, {0, 0, -1}}), HasSubstr("Truth: the ray meets edge AB."));
  EXPECT_THAT(proof({{0, 1, 1}, {0, 0, -1}}), HasSubstr("Truth: the ray meets vertex C."));
  EXPECT_THAT(proof({{2, 1, 1}, {0, 0, -1}}),
              HasSubstr("Truth: the line passes outside the triangle: the ray misses."));
  EXPECT_THAT(proof({{0, 0, 1}, {1, 0, 0}}), HasSubstr("Truth: the ray runs beside the plane: it misses."));
  EXPECT_THAT(proof({{-1, 0, 0}, {1, 0, 0}}), HasSubstr("touches the triangle without crossing it"));
  EXPECT_THAT(proof({{2, 0, 0}, {1, 0, 0}}), HasSubstr("not (ts and ts[-1] >= T_MIN)"));
  EXPECT_THAT(proof({{0, 0, 1}, {0, 0, -1}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), HasSubstr("no area"));
  EXPECT_THAT(proof({{0.25, 0.25, 1}, {0, 0, 1}}), HasSubstr("but before t_min: the ray misses."));
  EXPECT_THAT(proof({{0.25, 0.25, 1}, {0, 0, -1}, 0, 0.5}), HasSubstr("but behind t_max: the ray misses."));
  EXPECT_THAT(proof({{0.25, 0.25, 1}, {0, 0, -1}, -inf, inf}), HasSubstr("T_MIN, T_MAX = None, None"));
}

TEST(Repro, ScenesHoldTheWholeBag) {
  Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  c.bag.triangles.push_back({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_EQ(code_of(to_repro(c, ReproForm::obj, ""), ReproForm::obj),
            "o triangles\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n"
            "o ray\nv 0.25 0.25 1\nv 0.25 0.25 -3\nl 7 8\n");
  EXPECT_EQ(code_of(to_repro(c, ReproForm::ply, ""), ReproForm::ply),
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
            "element face 2\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n"
            "property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 0\n0 1 0\n0.25 0.25 1\n0.25 0.25 -3\n"
            "3 0 1 2\n3 3 4 5\n6 7\n");
}

TEST(Repro, AscHoldsThePlate) {
  Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  const auto put = [&c] { return code_of(to_repro(c, ReproForm::asc, ""), ReproForm::asc); };
  const std::string shape = " V { { 0 0 0 } { 1 0 0 } { 0 1 0 } } F { { 0 1 2 } }";
  EXPECT_EQ(put(), "title {triangles under a ray}\nunits mm\nput bag bot mode surf orient no" + shape + "\n");
  c.bag.mode = BagMode::plate;
  c.bag.thickness = 0.125;
  c.bag.orientation = Orientation::cw;
  EXPECT_THAT(put(), HasSubstr("mode plate orient lh" + shape + " T { 0.125 } fm 00\n"));
  c.bag.cosine = false;
  c.bag.position = PlatePosition::appended;
  EXPECT_THAT(put(), HasSubstr("mode plate_nocos orient lh" + shape + " T { 0.125 } fm ff\n"));
}

TEST(Repro, NothingForeignBreaksOut) {
  const Case plain = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}}, Precision::binary32);
  Case hostile = plain;
  hostile.id = "*/'\"\"\"';<script>&\nimport os\r\\";
  hostile.provenance = {
      "@MAIN@ \?\?/",
      "ends in a backslash \\",
      "*/ int main() { return 0; } /*",
      "'''\"\"\"; DROP TABLE x;",
      "</script><script>alert(1)</script>",
      "\xe2\x80\xa8process.exit(0)",
      "}}} [exec rm] {{{",
      "coding: utf-7",
      "end_header\nput x"};
  for (const ReproForm form : all_forms) {
    if (!possible(form)) continue;
    EXPECT_EQ(code_of(to_repro(hostile, form, ""), form), code_of(to_repro(plain, form, ""), form)) << name(form);
    for (const char c : to_repro(hostile, form, "")) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << name(form);
    EXPECT_THAT(to_repro(hostile, form, ""), Not(HasSubstr("\\\n"))) << name(form);
  }
}

TEST(Repro, RefusesWhatItCannotTell) {
  const Case good = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  Case two = good;
  two.bag.triangles.push_back(unit);
  EXPECT_THAT(error_of(two, ReproForm::cpp_plain, ""),
              AllOf(HasSubstr("'some-case' has 2 triangles"), HasSubstr("obj")));
  EXPECT_EQ(error_of(two, ReproForm::python_proof, ""), "");
  Case still = good;
  still.ray.direction = {};
  EXPECT_THAT(error_of(still, ReproForm::python_proof, ""), HasSubstr("the direction is zero"));
  EXPECT_EQ(error_of(still, ReproForm::obj, ""), "");
  Case endless = good;
  endless.bag.triangles.front().a.x = inf;
  for (const ReproForm form : all_forms) {
    if (possible(form)) {
      EXPECT_THAT(error_of(endless, form, ""), HasSubstr("finite")) << name(form);
    }
  }
  Case tenth = good;
  tenth.ray.origin.x = 0.1;
  EXPECT_THAT(error_of(tenth, ReproForm::cpp_plain, "plucker_f32"),
              AllOf(HasSubstr("not binary32"), HasSubstr("plucker_f32")));
  EXPECT_THAT(error_of(good, ReproForm::cpp_plain, "brlcad_bot_classic"),
              AllOf(HasSubstr("cpp-plain"), HasSubstr("brlcad_bot_classic"), HasSubstr("python-proof")));
  EXPECT_THAT(error_of(good, ReproForm::cpp_plain, "plucker_f32_fast_math"), HasSubstr("cpp-plain"));
  Case plate = good;
  plate.bag.mode = BagMode::plate;
  EXPECT_THAT(error_of(plate, ReproForm::c_librt, ""), AllOf(HasSubstr("plate"), HasSubstr("asc")));
}

TEST(Repro, TellsALibraryOffOnlyIfItWasAsked) {
  const Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  Case known = c;
  known.known = {{"brlcad_librt", VerdictKind::false_miss}};
  if (!tracer_named("brlcad_librt")) {
    EXPECT_TRUE(to_repro(known, ReproForm::c_librt, "")
                    .starts_with("// brlcad_librt is known to get this ray wrong: false-miss."));
    EXPECT_TRUE(to_repro(c, ReproForm::c_librt, "").starts_with("// What does brlcad_librt say of this ray?"));
  }
  EXPECT_TRUE(to_repro(c, ReproForm::js_three, "").starts_with("// What does three.js say of this ray?"));
}

TEST(Repro, NoProgramAsksWhatTheLibraryDoesNotTake) {
  if (!possible(ReproForm::cpp_embree)) GTEST_SKIP() << "this build has no Embree";
  const Case behind = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}, -1, 2}, Precision::binary32);
  EXPECT_THAT(error_of(behind, ReproForm::cpp_embree, "embree_robust"),
              AllOf(HasSubstr("beyond what embree_robust takes"), HasSubstr("obj")));
  const std::string proof = to_repro(behind, ReproForm::python_proof, "embree_robust");
  EXPECT_THAT(proof,
              AllOf(HasSubstr("# embree_robust gives no answer to this ray.\n"), HasSubstr("It said: nothing.")));
}

TEST(Repro, AProofTakesAnyTracersName) {
  const Case c = case_of(unit, {{0.25, 0.25, 1}, {0, 0, -1}});
  const std::string text = to_repro(c, ReproForm::python_proof, "./my\ntracer.so");
  EXPECT_THAT(text, HasSubstr("# What does ./my\\x0atracer.so say of this ray?\n"));
}

}  // namespace
}  // namespace plumbline
