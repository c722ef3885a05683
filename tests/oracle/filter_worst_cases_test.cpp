// The filter where its rounding errors come nearest to its bounds: cases found by filter_error_nightly, in which a
// determinant is computed with the wrong sign, more than 1/16 of its bound from zero, while all else is certain. With a
// bound 16 times smaller the filter would decide each of them, and wrongly.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/filter_search.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

struct WorstCase {
  Measured measured;
  int rounding;
  Shot shot;
};

// Above each, how far on the wrong side, in bounds.
const WorstCase worst_cases[] = {
    // 0.074
    {Measured::det, FE_TONEAREST,
     {{{0x1.8878b5ed6d37ep-5, -0x1.eecfc585b2e3fp-2, -0x1.b28fa1090a12p-2},
       {0x1.0d3089f5dd8cp-1, 0x1.4d30d521df1dp-4, 0x1.08aff5deeb09ep-3},
       {-0x1.df88da1196bc8p-2, 0x1.830bd6f3a043cp-4, -0x1.beb7c3d749373p-1}},
      {{-0x1.957f659a0a86ep-3, -0x1.6125148fabf6ep-1, 0x1.c076f0a2918d3p-2},
       {-0x1.a82c899004c6fp-2, -0x1.d600010a11653p-2, -0x1.e77f58e549f11p-2}}}},
    // 0.139
    {Measured::det, FE_UPWARD,
     {{{-0x1.ca3ddf02c36b2p-2, 0x1.5467e917cc051p-1, 0x1.8dc7f5791cb47p-2},
       {-0x1.dcaea7ee81e9p+0, -0x1.77e9198cd3a1fp-1, -0x1.0663e57fad294p+0},
       {0x1.f69b84b7b4624p-1, -0x1.878bc0684160fp-1, -0x1.0aef70f2587c4p+0}},
      {{0x1.0bf215fb383b3p-1, -0x1.24116b9195b65p-1, 0x1.90f9be00b0445p-1},
       {-0x1.2fafb3a1f7017p-2, 0x1.174e5d82144b2p-1, 0x1.183200773799p-1}}}},
    // 0.140
    {Measured::det, FE_DOWNWARD,
     {{{-0x1.a1d3d4cad01fep-1, 0x1.10d20d09533b7p-1, 0x1.6e44cf50f24ep-1},
       {0x1.dc1467d9398c9p-3, 0x1.7e6214ae11785p+0, -0x1.9f902a3abc9a7p-3},
       {0x1.e47c5a163b5f6p-3, -0x1.1070198b9cdfdp-1, -0x1.7b68e9d288ea5p-2}},
      {{-0x1.42103ac3cf64fp-1, -0x1.88e69426eb963p-5, -0x1.bd114734a7899p-1},
       {0x1.2218518d82be3p-1, -0x1.7ccc1104d38d3p-2, -0x1.22ed7df642b05p-1}}}},
    // 0.078
    {Measured::T, FE_TONEAREST,
     {{{-0x1.01591425319eap-3, -0x1.850cef7176208p-5, 0x1.90810871bf904p-1},
       {-0x1.7e3636400b486p-1, -0x1.383f5d343f8fp-1, -0x1.d8a0d08ac4408p-5},
       {-0x1.f703a6ab7522p-1, 0x1.a88cb812c2977p-1, 0x1.986c77093a5a8p-6}},
      {{-0x1.476ca5f6b4223p-1, -0x1.5329243aa4e9cp-2, 0x1.0ccdb85fc18eap-3},
       {0x1.8f16dfba408abp-3, 0x1.d5d4b37ee3141p-3, 0x1.957e7c3342e8fp-4}}}},
    // 0.149
    {Measured::T, FE_UPWARD,
     {{{0x1.a601de0c2f474p-1, -0x1.d26d3032cff7cp-2, 0x1.d4bbae760265ap-6},
       {0x1.9c21be92fba1ep-3, 0x1.880405a2c13d6p-3, 0x1.51cce995dfe4ep-1},
       {0x1.6c99c62fca935p-3, -0x1.18a0851f5c8d7p+0, 0x1.51df4a4711a94p-1}},
      {{0x1.9606380b7d8f6p-3, -0x1.e19a8c28b931ap-1, 0x1.48fdd3525a5fcp-1},
       {0x1.def9b3076fad5p-6, 0x1.f4da1d37242c1p-1, 0x1.ea13253718defp-7}}}},
    // 0.150
    {Measured::T, FE_DOWNWARD,
     {{{0x1.247dc234ecc01p-1, -0x1.9bab308383f6bp-2, -0x1.8b8efb7bb68f9p-1},
       {-0x1.720adb8ec55eap-1, 0x1.b4435507fa53p-1, 0x1.1058ec7dae0c6p-1},
       {-0x1.6d8ce08b99c58p-1, -0x1.b4c7312e66a02p+0, 0x1.04701fc25a9b8p-1}},
      {{-0x1.4e0af3a0a230fp-5, -0x1.89495c540eebep-2, -0x1.4541428843403p-3},
       {0x1.50e783aa62d64p-5, -0x1.27397aa7d08e1p-4, -0x1.54a7d0a6bc8b4p-4}}}},
    // 0.103
    {Measured::w_ab, FE_TONEAREST,
     {{{0x1.9be070883d426p-3, 0x1.49fef2d481638p-5, -0x1.dba64f7b06307p-4},
       {-0x1.6954372424096p-2, 0x1.388ed6f7da091p-1, 0x1.1f62991b8d138p-1},
       {0x1.667d5e0457f8p-10, -0x1.1d6e0dafd6eedp-8, -0x1.66b3ae5188589p-4}},
      {{-0x1.50341c43d2b8p-2, 0x1.234b8ffd4a3f6p-1, 0x1.748ed7db24d87p-2},
       {0x1.0e008b9701c87p-1, -0x1.bb0c9a22bb002p-2, 0x1.f3f405ae573b4p-2}}}},
    // 0.169
    {Measured::w_ab, FE_UPWARD,
     {{{-0x1.12fbd6a40eb5p-1, -0x1.4a62eb6530ad9p-1, 0x1.2481d5e6d197fp-4},
       {0x1.da3f7b65de3bdp-2, 0x1.2d92896973575p-4, -0x1.dbb9cb64ed332p-1},
       {-0x1.8d97d3a99e301p-1, -0x1.aee1419b3a21dp-4, -0x1.6dbe47a713a78p-2}},
      {{-0x1.da5aeba1abcc5p-3, -0x1.6031cca9183a7p-2, -0x1.ea20700941a42p-3},
       {-0x1.b7fc0e323a8fdp-4, 0x1.c87e4aa2c8cd4p-4, 0x1.8757335b3afd3p-4}}}},
    // 0.158
    {Measured::w_ab, FE_DOWNWARD,
     {{{0x1.215b7f4a665bep-1, 0x1.99de9d863f24ap+0, -0x1.deb4e563df706p-1},
       {-0x1.67c8ca258c4cbp-1, 0x1.365c1e7fc6e03p-2, 0x1.75c876a4cebd7p-2},
       {0x1.129c171361ce9p-1, 0x1.90e88a295307fp-2, -0x1.10f26e2c32e32p-1}},
      {{-0x1.058e25b1c0121p-1, 0x1.9c3b5fccde695p-2, 0x1.0d98118a31e85p-2},
       {0x1.c68cada1fdabcp-2, -0x1.99ffa87000403p-2, 0x1.879c28d1f2db6p-2}}}},
    // 0.076
    {Measured::w_bc, FE_UPWARD,
     {{{-0x1.0d5d21e53aac8p-1, 0x1.28638658b42bap-9, -0x1.ce09422f7aaf5p-2},
       {0x1.042856415b4e1p-5, -0x1.b2a95a5b8f514p-2, 0x1.f8abb25659657p-4},
       {-0x1.1207886474dbap-7, 0x1.3d1c55afcd43dp-1, -0x1.ffe66bf608d44p-1}},
      {{0x1.77ead62ab353cp-7, -0x1.6d1c4a2dd024fp-5, -0x1.17619922808ccp-2},
       {-0x1.5ee563d88d3eap-1, 0x1.638d859769c9fp-1, 0x1.71ddb61dca2dap-1}}}},
    // 0.080
    {Measured::w_bc, FE_DOWNWARD,
     {{{-0x1.edf354272c486p-1, -0x1.4717a69c8f3ebp-3, -0x1.8bcfec00117bep-1},
       {0x1.c55e9b81115c7p-3, -0x1.03f625e53e603p+0, 0x1.7a0af5dce41efp-2},
       {0x1.df0d18537c90fp-4, 0x1.de56e3c79e19ap-1, -0x1.99e4e4badab99p+0}},
      {{0x1.93304cbbc0f72p-4, -0x1.3c0068ea63f29p-1, 0x1.90c5f9d3e1e95p-3},
       {-0x1.29e89366bde9bp-1, 0x1.3857863eb73b8p-1, 0x1.3e138c89c499ep-1}}}},
    // 0.091
    {Measured::w_ca, FE_TONEAREST,
     {{{-0x1.18238f2869792p-3, 0x1.2c2f8368dc79fp-1, -0x1.493949278f34cp-5},
       {-0x1.58f0143df5974p-1, -0x1.87d03662bf2bdp-3, 0x1.8651e577ae298p-1},
       {0x1.e09fc9fb31fa6p-1, -0x1.fce5701465ab8p-2, 0x1.608201fd57588p-7}},
      {{0x1.9c0e296428a7dp-3, 0x1.a2e6cd107f6abp-3, -0x1.b98dffa5fdc93p-2},
       {0x1.6d797dd5da991p-1, -0x1.4cad4bf772db4p-1, 0x1.6e4409c267d41p-1}}}},
    // 0.174
    {Measured::w_ca, FE_UPWARD,
     {{{-0x1.7ca13b92dc61p-1, 0x1.d6c01105d5151p-3, -0x1.01be7de3b7076p-5},
       {-0x1.2ffa96fd23a68p-2, 0x1.e789256acc5e4p-2, -0x1.fb4e291061e7bp-2},
       {-0x1.3db1e4b7f383ep-4, -0x1.8d39c58d09d63p-1, 0x1.f1e035648b973p-1}},
      {{-0x1.d765ff7e39916p-3, -0x1.438686cced4dap-2, 0x1.eefb20791f157p-2},
       {0x1.45382bb4b5d6ap+0, 0x1.e1335bb0f35bfp-1, -0x1.4fcb0d0258ce6p+0}}}},
    // 0.169
    {Measured::w_ca, FE_DOWNWARD,
     {{{-0x1.45636e90e7637p-1, -0x1.40108cb59432fp+0, 0x1.e7213726c6d3dp-1},
       {0x1.13d628c0c6ce4p-3, 0x1.9a49b0cc5012ep-4, 0x1.3aee213a09976p-5},
       {0x1.70db012ebd286p+0, 0x1.e21778e234073p-3, -0x1.1b27c25a0daaep+0}},
      {{0x1.28c979d20d512p-1, -0x1.1ab16957b3667p-2, -0x1.f56ef36f2a7f3p-3},
       {-0x1.aba428e3dd8efp-1, 0x1.06eab47c67f3cp+0, 0x1.e65983c6219b1p-1}}}},
    // 0.065
    {Measured::V, FE_TONEAREST,
     {{{0x1.fe98c846c0352p-3, -0x1.4cbe1eabde6ddp-3, 0x1.eda122529e845p-3},
       {0x1.176611d675807p-1, -0x1.df2ca3bd608a2p-2, -0x1.bc47c7b4a42p-5},
       {-0x1.c880f4b40971ep-5, -0x1.df1c7f1fad4f3p-2, 0x1.015a710bf8d34p-4}},
      {{0x1.7f5121a934db6p-2, -0x1.08090630cb5a2p-2, 0x1.c93dcb0d859d3p-4},
       {0x1.a0fee2b3c3719p-4, -0x1.34736d1e660bap-3, -0x1.b26de6018c6a6p-4}, 0x1p+0}}},
    // 0.159
    {Measured::V, FE_UPWARD,
     {{{-0x1.53a2c735fee76p-1, 0x1.bee6a293adac6p-1, 0x1.1bd189d0b856ap+0},
       {0x1.9f5f7cdd31351p-2, -0x1.cede9b7071adfp-3, 0x1.83b2121741cecp-3},
       {-0x1.9e5b161c38695p+0, -0x1.34034a2a9db77p-3, 0x1.1aa81c6a2b5ep-5}},
      {{-0x1.51215e930b624p-1, -0x1.27ee0577d97b1p-3, 0x1.33913b0f50434p-3},
       {0x1.1f41956f3e19p-8, -0x1.ab4e57e0929cep-7, -0x1.de9272a1df30cp-7}, 0x1p+0}}},
    // 0.134
    {Measured::V, FE_DOWNWARD,
     {{{0x1.ad813f420a5c3p-4, 0x1.b13f757b96c23p-3, -0x1.5e3b2a7254b2ap-1},
       {-0x1.5de4b4d113eb7p-1, 0x1.fd0b8b89a0cccp-1, -0x1.45b7d53486f08p+0},
       {-0x1.bb875843d390ap-2, 0x1.cea31d1c0b2f8p-1, 0x1.47f9c4f580307p-4}},
      {{-0x1.c2929da7a9ec5p-2, 0x1.844d6ae88f33ap-1, -0x1.014adb653bbf4p+0},
       {-0x1.416cd8d263227p-7, 0x1.f30ce53640ea8p-7, -0x1.33536475057b4p-7}, 0x1p+0}}},
    // 2.458
    {Measured::V_alone, FE_TONEAREST,
     {{{0x1.04277fd9dd238p-3, 0x1.581ba160996e9p-2, 0x1.b54afa7fbf927p-1},
       {-0x1.4fb8e6a06ddbcp-3, -0x1.0f8f70c373652p-1, 0x1.88f7bd343e21fp-4},
       {-0x1.d03c8346ddf99p-1, 0x1.d49d41faff1dfp-1, -0x1.9cc103aeef35cp-4}},
      {{0x1.c23e673007facp-4, 0x1.459f060dac0cap-2, 0x1.ab4c7efd62a4cp-1},
       {-0x1.ed837237c385ep-1, 0x1.20130660e655fp-1, -0x1.c72f8f1309d08p-1}, 0x1p+0}}},
};

TEST(FilterWorstCases, AreDecidedRightlyOrNotAtAll) {
  for (const WorstCase& worst : worst_cases) {
    const FloatEnvironment environment{.rounding = worst.rounding};
    SCOPED_TRACE(testing::Message() << measured_names[static_cast<std::size_t>(worst.measured)] << ' ' << environment);
    const double wrong = ratio(worst.shot, worst.measured, Objective::wrong_side, environment);
    EXPECT_GT(wrong, 1.0 / 16);
    if (worst.measured != Measured::V_alone) {
      EXPECT_LT(wrong, 0.5);
    }
    const Truth expected = judges::mpq_truth(worst.shot.triangle, worst.shot.ray);
    for (const Stage& stage : all_stages()) {
      std::optional<Truth> answer;
      {
        const FloatScope scope(environment);
        answer = ask(stage, worst.shot);
      }
      if (answer) {
        EXPECT_EQ(*answer, expected) << stage.name() << '\n' << explain(worst.shot.triangle, worst.shot.ray);
      }
    }
  }
}

// Triangles far smaller or larger than their distance, and directions of any length: each bound has norms of its own.
// The rays are aimed at edges and vertices, or start in the plane, and end about where they meet it, as nearly as rounding
// lets.
TEST(FilterWorstCases, NormsOfDifferentSizes) {
  Random random(judges::seed());
  std::vector<Shot> shots;
  std::vector<Truth> expected;
  const auto unit = [&] { return static_cast<double>(uniform(random, -(1ll << 53) + 1, (1ll << 53) - 1)) * 0x1p-53; };
  const auto vec = [&] { return Vec3{unit(), unit(), unit()}; };
  const auto sum = [](const Vec3& p, double k, const Vec3& q) { return Vec3{p.x + k * q.x, p.y + k * q.y, p.z + k * q.z}; };
  for (int i = 0; i < 20000; ++i) {
    const auto size = [&] { return std::ldexp(1.0, static_cast<int>(uniform(random, -40, 40))); };
    const double edges = size(), distance = size(), length = size(), along = random() % 4 == 0 ? 0 : std::fabs(unit());
    const Vec3 a = vec(), b = sum(a, edges, vec()), c = sum(a, edges, vec());
    const Vec3 target = sum(sum(a, along, b), -along, a);
    Vec3 origin = sum(target, distance, vec()), direction = sum(target, -1, origin);
    switch (random() % 4) {
      case 0:  // from near the vertex that the edge does not have
        origin = sum(c, edges * std::fmin(distance, 1), vec());
        direction = sum(target, -1, origin);
        break;
      case 1: {  // from the plane
        const double near = std::fmin(distance, 0.4);
        origin = sum(sum(sum(a, near, b), near, c), -2 * near, a);
        direction = vec();
        break;
      }
      default: break;
    }
    Shot shot{{a, b, c}, {origin, sum({}, length, direction)}};
    if (random() % 2 == 0) std::swap(shot.triangle.a, shot.triangle.b);
    for (auto turns = random() % 3; turns > 0; --turns)
      shot.triangle = {shot.triangle.b, shot.triangle.c, shot.triangle.a};
    if (random() % 2 == 0) shot.ray.t_max = 1 / length;
    if (random() % 4 == 0) {  // backwards: negative t
      const Vec3& d = shot.ray.direction;
      shot.ray.direction = {-d.x, -d.y, -d.z};
      shot.ray.t_min = -1 / length;
    }
    if (shot.ray.direction == Vec3{}) continue;
    shots.push_back(shot);
    expected.push_back(judges::mpq_truth(shot.triangle, shot.ray));
  }
  for (const Stage& stage : all_stages()) {
    if (stage.kind == Stage::residue || stage.kind == Stage::integer) continue;
    const auto answers = ask(stage, shots);
    for (std::size_t i = 0; i < shots.size(); ++i)
      if (answers[i]) {
        ASSERT_EQ(*answers[i], expected[i]) << stage.name() << '\n' << explain(shots[i].triangle, shots[i].ray);
      }
  }
}

}  // namespace
}  // namespace plumbline
