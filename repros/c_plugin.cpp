// A tracer of somebody's own, from a shared library made with plumbline_tracer.h: as float_tracer/plugin.cpp asks it, but in
// one process, where a debugger sees it.
#include <fmt/format.h>

#include <filesystem>

#include "analysis/tracers.h"
#include "case/input_error.h"
#include "float_tracer/plugin.h"
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command =
    "cc -g repro.c -I INCLUDE -ldl -o repro && ./repro      # TRACER=./other.so ./repro";

constexpr std::string_view text = R"(@STORY@
#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "plumbline_tracer.h"  // INCLUDE: the folder where it is

static const char* library(void) {
  const char* other = getenv("TRACER");
  return other != NULL ? other : @LIBRARY@;
}

@CASE@
@ANSWER@
static void fail(const char* what) {
  fprintf(stderr, "%s\n", what);
  exit(2);
}

static const plumbline_tracer_table* load(void) {
  void* loaded = dlopen(library(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == NULL) fail(dlerror());
  const plumbline_tracer_table* (*tracer)(void) = NULL;
  *(void**)&tracer = dlsym(loaded, "plumbline_tracer");
  if (tracer == NULL) fail("it exports no plumbline_tracer");
  const plumbline_tracer_table* table = tracer();
  if (table->version != PLUMBLINE_TRACER_VERSION) fail("it is of another version of plumbline_tracer.h");
  return table;
}

static Answer ask(void) {
  const plumbline_tracer_table* table = load();
  const @REAL@ vertices[9] = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
  const plumbline_ray_@SIZE@ ray = {{origin[0], origin[1], origin[2]},
                                  {direction[0], direction[1], direction[2]}, t_min, t_max};
  plumbline_answer got = {PLUMBLINE_FAULT, 0, 0, 0, 0, 0, 0};
  void* bag = table->prepare_@SIZE@(vertices, 1);
  if (bag == NULL || table->trace_@SIZE@(bag, &ray, 1, &got) != 1 || got.outcome > PLUMBLINE_HIT) fail("it gives no answer");
  const Answer answer = {got.outcome == PLUMBLINE_HIT, got.t, got.u, got.v};
  if (table->release != NULL) table->release(bag);
  return answer;
}

@MAIN@)";

}  // namespace

std::string c_plugin(const Case& what, std::string_view tracer) {
  const Tracer* const mine = tracer_named(tracer);
  if (!mine || !is_plugin(mine->info()))
    throw InputError(fmt::format("c-plugin: '{}' is no shared library of yours; name it, as in --tracer ./libmine.so",
                                 tracer));
  const Evidence e = gather_to_ask(what, tracer);
  const bool single = e.contract.precision == Precision::binary32;
  const std::string_view type = single ? "static const float" : "static const double";
  const bool has_t = e.answer && e.answer->has_t, has_uv = e.answer && e.answer->has_uv;
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"LIBRARY", c_string(std::filesystem::absolute(mine->info().source).lexically_normal().string())},
                     {"REAL", single ? "float" : "double"},
                     {"SIZE", single ? "f32" : "f64"},
                     {"CASE", c_triangle(e, type) + c_ray(e, type) + c_range(e, type)},
                     {"ANSWER", c_answer()},
                     {"MAIN", c_main(e, {.t = has_t, .uv = has_uv})}});
}

}  // namespace plumbline
