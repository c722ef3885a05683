#include "oracle/bag/bag_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "case/input_error.h"
#include "tests/oracle/bag/bags.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::uint32_t> triangles_of(const BagTruth& truth) {
  std::vector<std::uint32_t> list;
  for (const BagHit& hit : truth.hits) list.push_back(hit.triangle);
  return list;
}
std::vector<std::uint32_t> ranks_of(const BagTruth& truth) {
  std::vector<std::uint32_t> list;
  for (const BagHit& hit : truth.hits) list.push_back(hit.rank);
  return list;
}

using Indices = std::vector<std::uint32_t>;

// The square z = at over [0, 2]^2, its diagonal from (0, 0) to (2, 2).
std::vector<Triangle> sheet(double at) {
  return {{{0, 0, at}, {2, 0, at}, {2, 2, at}}, {{0, 0, at}, {2, 2, at}, {0, 2, at}}};
}
std::vector<Triangle> operator+(std::vector<Triangle> x, const std::vector<Triangle>& y) {
  x.insert(x.end(), y.begin(), y.end());
  return x;
}

TEST(BagTruth, OfNothingIsNothing) {
  const BagTruth truth = bag_truth({}, Ray{.origin = {}, .direction = {0, 0, 1}});
  EXPECT_EQ(truth.invalid, Invalid::none);
  EXPECT_TRUE(truth.hits.empty());
  EXPECT_EQ(truth.nearest(), 0u);
  EXPECT_EQ(truth.crossings(), 0u);
}

TEST(BagTruth, IsInTheOrderOfT) {
  const auto bag = sheet(3) + sheet(1);
  const BagTruth truth = bag_truth(bag, Ray{.origin = {1.5, 0.5, 0}, .direction = {0, 0, 2}});
  EXPECT_EQ(triangles_of(truth), (Indices{2, 0}));
  EXPECT_EQ(ranks_of(truth), (Indices{0, 1}));
  EXPECT_EQ(truth.hits[0].t, 0x1p-1);
  EXPECT_EQ(truth.hits[1].t, 0x1.8p+0);
  EXPECT_EQ(truth.nearest(), 1u);
  EXPECT_EQ(truth.crossings(), 2u);
}

TEST(BagTruth, KeepsExactTies) {
  // On the diagonal of both sheets, and twice the nearer one.
  const auto bag = sheet(1) + sheet(3) + sheet(1);
  const BagTruth truth = bag_truth(bag, Ray{.origin = {1, 1, 0}, .direction = {0, 0, 1}});
  EXPECT_EQ(triangles_of(truth), (Indices{0, 1, 4, 5, 2, 3}));
  EXPECT_EQ(ranks_of(truth), (Indices{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(truth.nearest(), 4u);
  EXPECT_EQ(truth.crossings(), 3u);  // one owner of each diagonal
}

TEST(BagTruth, TellsTApartWhereDoublesDoNot) {
  // t = 1/3 and 1/3 + 2^-60 / 3: rounded alike.
  const auto bag = sheet(1 + 0x1p-52) + sheet(1);
  const BagTruth truth = bag_truth(bag, Ray{.origin = {1.5, 0.5, 0}, .direction = {0, 0, 0x1p+60}});
  EXPECT_EQ(triangles_of(truth), (Indices{2, 0}));
  EXPECT_EQ(ranks_of(truth), (Indices{0, 1}));
  // And without a difference in the plane's height: skew planes that meet a hair beside the ray.
  const Triangle tilted = {{0, 0, 1 - 0x1p-53}, {2, 0, 1}, {2, 2, 1}};
  const std::vector<Triangle> pair = {sheet(1)[0], tilted};
  const BagTruth close = bag_truth(pair, Ray{.origin = {2 - 0x1p-50, 0.5, 0}, .direction = {0, 0, 1}});
  EXPECT_EQ(triangles_of(close), (Indices{1, 0}));
  EXPECT_EQ(ranks_of(close), (Indices{0, 1}));
  EXPECT_EQ(close.hits[0].t, close.hits[1].t);
}

TEST(BagTruth, KeepsTheRange) {
  const auto bag = sheet(1) + sheet(2) + sheet(3);
  Ray ray{.origin = {1.5, 0.5, 0}, .direction = {0, 0, 1}, .t_min = 1, .t_max = 2};
  EXPECT_EQ(triangles_of(bag_truth(bag, ray)), (Indices{0, 2}));
  ray.t_min = std::nextafter(1, 2);
  EXPECT_EQ(triangles_of(bag_truth(bag, ray)), (Indices{2}));
  ray.t_min = -infinity;
  ray.t_max = infinity;
  ray.origin.z = 2.5;
  EXPECT_EQ(triangles_of(bag_truth(bag, ray)), (Indices{0, 2, 4}));
  ray.t_min = 1;
  ray.t_max = 0;
  EXPECT_TRUE(bag_truth(bag, ray).hits.empty());
}

TEST(BagTruth, HasOneOwnerOfASharedEdge) {
  const auto bag = sheet(1);
  for (const double x : {0.25, 1.0, 1.75}) {
    const BagTruth truth = bag_truth(bag, Ray{.origin = {x, x, 0}, .direction = {0, 0, 1}});
    ASSERT_EQ(truth.hits.size(), 2u);
    EXPECT_NE(truth.hits[0].owner, truth.hits[1].owner);
  }
}

TEST(BagTruth, OwnsAnInnerVertexOnce) {
  std::vector<Triangle> fan;
  const std::vector<Vec3> rim = {{2, 0, 1}, {1, 2, 1}, {-2, 1, 1}, {-1, -1, 1}, {1, -2, 1}};
  for (std::size_t i = 0; i < rim.size(); ++i) fan.push_back({{0, 0, 1}, rim[i], rim[(i + 1) % rim.size()]});
  for (const Vec3 direction : {Vec3{0, 0, 1}, Vec3{1, 2, 1}, Vec3{-3, 1, 1}, Vec3{7, -5, 1}}) {
    const Ray ray{.origin = {-direction.x, -direction.y, 0}, .direction = direction};
    const BagTruth truth = bag_truth(fan, ray);
    EXPECT_EQ(truth.hits.size(), rim.size());
    EXPECT_EQ(truth.nearest(), rim.size());
    EXPECT_EQ(truth.crossings(), 1u);
  }
}

TEST(BagTruth, OwnsNoneOrBothOfASilhouetteEdge) {
  // A ridge seen from the side: the ray touches it and goes through neither face, or through both.
  const std::vector<Triangle> ridge = {{{0, 0, 0}, {1, -1, 1}, {1, 1, 1}}, {{0, 0, 2}, {1, 1, 1}, {1, -1, 1}}};
  const BagTruth truth = bag_truth(ridge, Ray{.origin = {1, 0, -5}, .direction = {0, 0, 1}});
  ASSERT_EQ(truth.hits.size(), 2u);
  EXPECT_EQ(truth.hits[0].owner, truth.hits[1].owner);
  EXPECT_EQ(truth.signed_crossings(), 0);
}

TEST(BagTruth, ListsWhatItOnlyTouches) {
  const std::vector<Triangle> bag = {{{1, -1, 0}, {3, -1, 0}, {2, 2, 0}},  // in its plane
                                     {{5, 0, 0}, {5, 0, 0}, {5, 0, 0}},    // a point on it
                                     {{0, 0, 0}, {8, 0, 0}, {4, 0, 0}},    // a segment along it
                                     {{0, 1, 0}, {1, 1, 0}, {0, 1, 1}}};   // beside it
  const BagTruth truth = bag_truth(bag, Ray{.origin = {}, .direction = {2, 0, 0}, .t_min = 0, .t_max = 3});
  EXPECT_TRUE(truth.hits.empty());
  ASSERT_EQ(truth.stretches.size(), 3u);
  EXPECT_EQ(truth.stretches[0].triangle, 0u);
  EXPECT_EQ(truth.stretches[0].hit_class, HitClass::coplanar);
  EXPECT_EQ(truth.stretches[0].low, 0x1.5555555555555p-1);   // 4/3 / 2
  EXPECT_EQ(truth.stretches[0].high, 0x1.5555555555555p+0);  // 8/3 / 2
  EXPECT_EQ(truth.stretches[1].low, 2.5);
  EXPECT_EQ(truth.stretches[1].high, 2.5);
  EXPECT_EQ(truth.stretches[2].low, 0);
  EXPECT_EQ(truth.stretches[2].high, 3);  // cut by the range
  EXPECT_TRUE(truth.on_surface);
}

TEST(BagTruth, CountsNoCrossingsFromTheSurface) {
  const auto bag = sheet(1);
  EXPECT_EQ(bag_truth(bag, Ray{.origin = {1.5, 0.5, 1}, .direction = {1, 1, 1}}).crossings(), std::nullopt);
  EXPECT_EQ(bag_truth(bag, Ray{.origin = {1, 1, 1}, .direction = {1, 0, 0}}).crossings(), std::nullopt);
  // A t that is tiny, but not 0.
  const Ray above{.origin = {1.5, 0.5, 1 - 0x1p-53}, .direction = {0, 0, 0x1p+1000}};
  EXPECT_EQ(bag_truth(bag, above).crossings(), 1u);
  const std::vector<Triangle> low = {{{0, 0, 0x1p-1074}, {2, 0, 0x1p-1074}, {0, 2, 0x1p-1074}}};
  const BagTruth truth = bag_truth(low, Ray{.origin = {0.5, 0.5, 0}, .direction = {0, 0, 0x1p+100}});
  ASSERT_EQ(truth.hits.size(), 1u);
  EXPECT_EQ(truth.hits[0].t, 0);  // 2^-1174, rounded
  EXPECT_EQ(truth.crossings(), 1u);
}

TEST(BagTruth, SaysWhatIsInvalid) {
  const std::vector<Triangle> bag = {{{0, 0, 0}, {1, 0, 0}, {0, 1, NAN}}};
  EXPECT_EQ(bag_truth(bag, Ray{.origin = {}, .direction = {0, 0, 1}}).invalid, Invalid::triangle_not_finite);
  EXPECT_EQ(bag_truth({}, Ray{.origin = {}, .direction = {}}).invalid, Invalid::zero_direction);
  EXPECT_EQ(bag_truth(sheet(1), Ray{.origin = {infinity, 0, 0}, .direction = {0, 0, 1}}).invalid,
            Invalid::origin_not_finite);
  EXPECT_EQ(bag_truth(sheet(1), Ray{.origin = {}, .direction = {0, 0, 1}, .t_min = NAN}).invalid, Invalid::range_nan);
}

TEST(WindingNumber, OfABox) {
  const auto bag = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(winding_number(bag, {0, 0, 0}), 1);  // through the diagonal of a face
  EXPECT_EQ(winding_number(bag, {0.25, 0.5, 0.25}), 1);
  EXPECT_EQ(winding_number(bag, {-3, 0, 0}), 0);
  EXPECT_EQ(winding_number(bag, {-3, 1, 1}), 0);  // along an edge
  EXPECT_EQ(winding_number(bag, {-3, 1, 0}), 0);  // in the plane of a face
  EXPECT_EQ(winding_number(bag, {-3, -1, -1}), 0);
  EXPECT_EQ(winding_number(bag, {1, 0, 0}), std::nullopt);
  EXPECT_EQ(winding_number(bag, {1, 1, 1}), std::nullopt);
  EXPECT_EQ(winding_number(bag + box({-2, -2, -2}, {2, 2, 2}), {0, 0, 0}), 2);
  EXPECT_THROW(winding_number(bag, {NAN, 0, 0}), InputError);
}

}  // namespace
}  // namespace plumbline
