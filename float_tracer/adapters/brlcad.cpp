#include "float_tracer/adapters/brlcad.h"

// The standard library first: BRL-CAD's headers define macros with names such as X and INFINITY.
#include <brlcad/raytrace.h>
#include <brlcad/rtgeom.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>

#include "case/float_bits.h"
#include "float_tracer/brlcad/answer.h"

namespace plumbline {
namespace {

constexpr const char* object_name = "bag";

std::mutex library;  // guards every call of BRL-CAD, and bombed
bool bombed = false;

int discard(void*, void*) { return 0; }

// Holds the library, for one thread.
class Turn {
 public:
  Turn() : lock_(library) {
    static const bool quiet = (bu_log_add_hook(discard, nullptr), true);
    static_cast<void>(quiet);
  }
  bool possible() const { return !bombed; }

  /// Calls f, which must not keep anything that needs a destructor: a bomb jumps over it. False after a bomb.
  template <class F>
  bool run(F f) {
    if (BU_SETJUMP) {
      BU_UNSETJUMP;
      bombed = true;
      return false;
    }
    f();
    BU_UNSETJUMP;
    return true;
  }

 private:
  std::lock_guard<std::mutex> lock_;
};

bool finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

bool within_limits(const Bag& bag) {
  return bag.triangles.size() <= std::size_t{std::numeric_limits<int>::max()} / 3 && is_finite(bag.thickness) &&
         std::ranges::all_of(bag.triangles,
                             [](const Triangle& t) { return finite(t.a) && finite(t.b) && finite(t.c); });
}

unsigned char mode_of(const Bag& bag) {
  switch (bag.mode) {
    case BagMode::surface:
      return RT_BOT_SURFACE;
    case BagMode::solid:
      return RT_BOT_SOLID;
    case BagMode::plate:
      break;
  }
  return bag.cosine ? RT_BOT_PLATE : RT_BOT_PLATE_NOCOS;
}

unsigned char orientation_of(const Bag& bag) {
  switch (bag.orientation) {
    case Orientation::ccw:
      return RT_BOT_CCW;
    case Orientation::cw:
      return RT_BOT_CW;
    case Orientation::none:
      break;
  }
  return RT_BOT_UNORIENTED;
}

template <class T>
T* allocate(std::size_t count) {
  return static_cast<T*>(bu_calloc(static_cast<unsigned>(count), sizeof(T), "bag"));
}

// What wdb_export takes, and frees. libwdb's mk_bot would make the same, but forgets the thickness of a plate without
// cosine.
rt_bot_internal* bot_of(const Bag& bag) {
  const std::size_t count = bag.triangles.size();
  auto* bot = allocate<rt_bot_internal>(1);
  bot->magic = RT_BOT_INTERNAL_MAGIC;
  bot->mode = mode_of(bag);
  bot->orientation = orientation_of(bag);
  bot->num_vertices = 3 * count;
  bot->num_faces = count;
  bot->vertices = allocate<fastf_t>(9 * count);
  bot->faces = allocate<int>(3 * count);
  fastf_t* to = bot->vertices;
  for (const Triangle& t : bag.triangles)
    for (const Vec3* v : {&t.a, &t.b, &t.c})
      for (const double x : {v->x, v->y, v->z}) *to++ = x;
  for (std::size_t i = 0; i < 3 * count; ++i) bot->faces[i] = static_cast<int>(i);
  if (bag.mode != BagMode::plate) return bot;

  bot->thickness = allocate<fastf_t>(count);
  std::fill_n(bot->thickness, count, bag.thickness);
  bot->face_mode = bu_bitv_new(static_cast<unsigned>(count));
  if (bag.position == PlatePosition::appended)
    for (std::size_t i = 0; i < count; ++i) BU_BITSET(bot->face_mode, i);
  return bot;
}

// A model of one BoT, and what librt needs to shoot at it. Null pointers: not there yet.
struct Model {
  db_i* database = nullptr;
  rt_i* instance = nullptr;
  resource* memory = nullptr;
  bool shootable = false;
};

// False if BRL-CAD refuses, or would die of a ray: what is left of more than 32 faces fits in one piece, and for that
// it makes no state. It reports success even where it dropped the only face: whoever shoots has to look at
// Model::shootable.
bool build(const Bag& bag, Model& model) {
  model.database = db_open_inmem();
  if (!model.database) return false;
  if (wdb_export(model.database->dbi_wdbp, object_name, bot_of(bag), ID_BOT, 1.0) < 0) return false;
  model.instance = rt_new_rti(model.database);
  model.memory = allocate<resource>(1);
  rt_init_resource(model.memory, 0, model.instance);
  if (rt_gettree(model.instance, object_name) < 0 && model.instance->nsolids > 0) return false;
  rt_prep(model.instance);
  soltab* solid = nullptr;
  for (bu_list& head : model.instance->rti_solidheads)
    for (BU_LIST_FOR(solid, soltab, &head)) {
      if (solid->st_npieces == 1) return false;
      model.shootable = true;
    }
  return true;
}

void free_model(const Model& model) {
  if (model.instance) {
    rt_free_rti(model.instance);
    rt_clean_resource_complete(nullptr, model.memory);
    bu_free(model.memory, "bag");
  }
  if (model.database) wdb_close(model.database->dbi_wdbp);
}

int keep_partitions(application* ap, partition* head, seg*) {
  auto& passages = *static_cast<std::vector<Passage>*>(ap->a_uptr);
  for (const partition* p = head->pt_forw; p != head; p = p->pt_forw)
    passages.push_back({.in = p->pt_inhit->hit_dist,
                        .out = p->pt_outhit->hit_dist,
                        .triangle_in = static_cast<std::uint32_t>(p->pt_inhit->hit_surfno),
                        .triangle_out = static_cast<std::uint32_t>(p->pt_outhit->hit_surfno)});
  return 1;
}

int keep_nothing(application*) { return 0; }

class PreparedModel final : public PreparedBag {
 public:
  explicit PreparedModel(const Bag& bag) : possible_(within_limits(bag)), thin_(bag.mode != BagMode::plate) {
    if (!possible_ || bag.triangles.empty()) return;
    Turn turn;
    possible_ = turn.possible();
    if (possible_) turn.run([&] { possible_ = build(bag, model_); });
    if (!turn.possible()) possible_ = false;
  }

  ~PreparedModel() override {
    Turn turn;
    if (turn.possible()) turn.run([&] { free_model(model_); });  // after a bomb it is leaked
  }

  bool passages(const Ray& ray, std::vector<Passage>& passages) override {
    Turn turn;
    const bool answered = shoot(turn, ray).outcome != Outcome::fault;
    if (answered)
      passages = passages_;
    else
      passages.clear();
    return answered;
  }

  PreparedModel(const PreparedModel&) = delete;
  PreparedModel& operator=(const PreparedModel&) = delete;

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    Turn turn;
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = shoot(turn, rays[i]);
  }

  Answer shoot(Turn& turn, const Ray& ray) {
    passages_.clear();
    if (!possible_ || !turn.possible() || !finite(ray.origin) || !finite(ray.direction))
      return {.outcome = Outcome::fault};
    if (!model_.shootable) return {};
    RT_APPLICATION_INIT(&shot_);
    shot_.a_rt_i = model_.instance;
    shot_.a_resource = model_.memory;
    shot_.a_hit = keep_partitions;
    shot_.a_miss = keep_nothing;
    shot_.a_onehit = 0;
    shot_.a_uptr = &passages_;
    VSET(shot_.a_ray.r_pt, ray.origin.x, ray.origin.y, ray.origin.z);
    VSET(shot_.a_ray.r_dir, ray.direction.x, ray.direction.y, ray.direction.z);
    if (!turn.run([&] { rt_shootray(&shot_); })) return {.outcome = Outcome::fault};
    return brlcad::answer_of(passages_, thin_);
  }

  Model model_;
  application shot_{};  // not a local variable: a jump would leave it indeterminate
  std::vector<Passage> passages_;
  bool possible_;
  bool thin_;  // in is the hit itself
};

class BrlcadTracer final : public Tracer {
 public:
  BrlcadTracer()
      : Tracer({.name = "brlcad_librt",
                .summary = "the real librt of BRL-CAD, a bag of triangles alone in a model",
                .source = "rt_shootray",
                .package = "BRL-CAD " PLUMBLINE_BRLCAD_VERSION,
                .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified},
                .has_tree = true,
                .isolation = Isolation::process}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedModel>(bag); }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> brlcad_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<BrlcadTracer>());
  return list;
}

}  // namespace plumbline
