// Records what a real BRL-CAD answers: brlcad_record > corpus/recorded/bags/brlcad-VERSION-bags.csv
//
// Of each kind of mesh but the largest, every kind of bag, with rays chosen so that it isn't mostly misses.
#include <cstdio>

#include "float_tracer/adapters/brlcad.h"
#include "float_tracer/tracer_list.h"
#include "tests/float_tracer/brlcad_meshes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

constexpr std::uint64_t seed = 724;
constexpr std::size_t largest_mesh = 100, rays_per_bag = 4;

void print(const char* what, std::initializer_list<Vec3> vectors) {
  std::printf("%s", what);
  for (const Vec3& v : vectors) std::printf(",%a,%a,%a", v.x, v.y, v.z);
}

void record() {
  const auto adapter = brlcad_tracers();
  const Tracer &real = *adapter.front(), &model = tracer_named("brlcad_bot_classic");
  std::printf(
      "# Recorded by running %s through its public API, with Plumbline's adapter (float_tracer/adapters/brlcad.h),\n"
      "# x86-64, by brlcad_record (tests/float_tracer/brlcad_record.cpp), seed %llu. Lengths in mm.\n"
      "# mesh,name; triangle,9 coordinates: of the mesh; bag,mode,orientation,thickness,position,cosine: of all its\n"
      "# triangles; ray,origin,direction, then of every partition in, out, surface number of in, of out: at that "
      "bag.\n",
      real.info().package.c_str(), static_cast<unsigned long long>(seed));
  Random random(seed);
  for (std::size_t kind = 0; kind < brlcad_mesh_kinds; ++kind) {
    const BrlcadMesh mesh = brlcad_mesh(kind, random);
    if (mesh.triangles.size() > largest_mesh) continue;
    std::printf("mesh,%s\n", mesh.kind.c_str());
    for (const Triangle& t : mesh.triangles) {
      print("triangle", {t.a, t.b, t.c});
      std::printf("\n");
    }
    for (const Bag& bag : brlcad_bags(mesh.triangles)) {
      std::printf("bag,%s,%s,%a,%s,%s\n", name(bag.mode).data(), name(bag.orientation).data(), bag.thickness,
                  name(bag.position).data(), bag.cosine ? "true" : "false");
      const auto prepared = real.prepare(bag), guard = model.prepare(bag);
      for (std::size_t recorded = 0, tries = 0; recorded < rays_per_bag && tries < 1000; ++tries) {
        const Ray ray = brlcad_ray(mesh.triangles, random);
        std::vector<Passage> passages;
        if (!guard->passages(ray, passages)) continue;  // the real one may hang of it
        if (!prepared->passages(ray, passages) || (passages.empty() && tries % 4 != 0)) continue;
        ++recorded;
        print("ray", {ray.origin, ray.direction});
        for (const Passage& p : passages) std::printf(",%a,%a,%u,%u", p.in, p.out, p.triangle_in, p.triangle_out);
        std::printf("\n");
      }
    }
  }
}

}  // namespace
}  // namespace plumbline

int main() { plumbline::record(); }
