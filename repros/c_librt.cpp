// As float_tracer/adapters/brlcad.cpp asks BRL-CAD's librt: a BoT of one triangle alone in a database in memory. What
// librt promises is told here as well, since few builds have it.
#include <fmt/format.h>

#include "case/input_error.h"
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr Contract contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified};

constexpr std::string_view command =
    "cc -std=gnu11 repro.c -I$BRLCAD/include -I$BRLCAD/include/brlcad -I$BRLCAD/include/openNURBS -L$BRLCAD/lib "
    "-lrt -lbu -lm -o repro && LD_LIBRARY_PATH=$BRLCAD/lib ./repro      # BRL-CAD 7.24";

constexpr std::string_view text = R"(@STORY@//
// What librt is held to: a ray from t = 0 on meets a closed triangle. Contact in its plane is no hit, and of t = 0
// nothing is said.
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include <brlcad/raytrace.h>
#include <brlcad/rtgeom.h>

@CASE@
@ANSWER@
static int keep_first(struct application* ap, struct partition* head, struct seg* unused) {
  Answer* answer = (Answer*)ap->a_uptr;
  (void)unused;
  answer->hit = true;
  answer->t = head->pt_forw->pt_inhit->hit_dist;
  return 1;
}

static int keep_nothing(struct application* ap) {
  (void)ap;
  return 0;
}

static struct rt_bot_internal* triangle(void) {
  struct rt_bot_internal* bot = (struct rt_bot_internal*)bu_calloc(1, sizeof(struct rt_bot_internal), "bot");
  int i;
  bot->magic = RT_BOT_INTERNAL_MAGIC;
  bot->mode = RT_BOT_SURFACE;
  bot->orientation = RT_BOT_@ORIENTATION@;
  bot->num_vertices = 3;
  bot->num_faces = 1;
  bot->vertices = (fastf_t*)bu_calloc(9, sizeof(fastf_t), "vertices");
  bot->faces = (int*)bu_calloc(3, sizeof(int), "faces");
  VMOVE(bot->vertices, a);
  VMOVE(bot->vertices + 3, b);
  VMOVE(bot->vertices + 6, c);
  for (i = 0; i < 3; i++) bot->faces[i] = i;
  return bot;
}

static Answer ask(void) {
  static struct application ap;
  Answer answer = {false, 0, 0, 0};
  struct db_i* database = db_open_inmem();
  struct rt_i* instance;
  size_t i;
  bool shootable = false;
  if (!database || wdb_export(database->dbi_wdbp, "bag", triangle(), ID_BOT, 1.0) < 0) {
    fprintf(stderr, "no database\n");
    exit(2);
  }
  instance = rt_new_rti(database);
  if (rt_gettree(instance, "bag") < 0 && instance->nsolids > 0) {
    fprintf(stderr, "no model\n");
    exit(2);
  }
  rt_prep(instance);
  for (i = 0; i < RT_DBNHASH; i++) shootable |= BU_LIST_NON_EMPTY(&instance->rti_solidheads[i]);
  if (!shootable) return answer; /* it dropped the triangle as degenerate */
  RT_APPLICATION_INIT(&ap);
  ap.a_rt_i = instance;
  ap.a_hit = keep_first;
  ap.a_miss = keep_nothing;
  ap.a_onehit = 0;
  ap.a_uptr = &answer;
  VMOVE(ap.a_ray.r_pt, origin);
  VMOVE(ap.a_ray.r_dir, direction);
  rt_shootray(&ap);
  return answer;
}

@MAIN@)";

std::string orientation(Orientation o) {
  return o == Orientation::ccw ? "CCW" : o == Orientation::cw ? "CW" : "UNORIENTED";
}

}  // namespace

std::string c_librt(const Case& what, std::string_view tracer) {
  if (what.bag.mode != BagMode::surface)
    throw InputError(
        fmt::format("case '{}' is a {}, and c-librt tells surfaces; export it as asc", what.id, name(what.bag.mode)));
  const Evidence e = gather_to_ask(what, tracer, contract);
  constexpr std::string_view type = "static const double";
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"CASE", c_triangle(e, type) + c_ray(e, type)},
                     {"ANSWER", c_answer()},
                     {"ORIENTATION", orientation(what.bag.orientation)},
                     {"MAIN", c_main(e, {.t = true})}});
}

}  // namespace plumbline
