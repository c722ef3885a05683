#include "repros/repro.h"

#include <array>

#include "analysis/tracers.h"
#include "float_tracer/plugin.h"
#include "repros/forms.h"

namespace plumbline {
namespace {

struct Library {
  ReproForm form;
  std::string_view prefix;              ///< of its tracers' names
  std::string_view binary32, binary64;  ///< whom the form asks that is not told
};

constexpr std::array<Library, 6> libraries = {{
    {ReproForm::cpp_plain, "", "moller_trumbore_f32", "moller_trumbore_f64"},
    {ReproForm::cpp_embree, "embree_", "embree_robust", "embree_robust"},
    {ReproForm::cpp_cgal, "cgal_", "cgal_cartesian_f64", "cgal_cartesian_f64"},
    {ReproForm::cpp_bullet, "bullet_", "bullet_f32", "bullet_f32"},
    {ReproForm::cpp_glm, "glm_", "glm_f32", "glm_f64"},
    {ReproForm::c_librt, "brlcad_", "brlcad_librt", "brlcad_librt"},
}};

// `tracer`, if the form can ask it, or else the form's own.
std::string_view asked_by(ReproForm form, const Case& what, std::string_view tracer) {
  for (const Library& library : libraries) {
    if (library.form != form) continue;
    const bool own = form == ReproForm::cpp_plain ? !tracer.empty() : repro_form_of(tracer) == form;
    if (own) return tracer;
    return what.precision == Precision::binary32 ? library.binary32 : library.binary64;
  }
  return tracer;
}

}  // namespace

ReproForm repro_form_of(std::string_view tracer) {
  if (tracer == "brlcad_bot_classic_kernel")
    return ReproForm::cpp_plain;  // a line at the primitive alone: no call of librt
  if (const Tracer* mine = tracer_named(tracer); mine && is_plugin(mine->info())) return ReproForm::c_plugin;
  for (const Library& library : libraries)
    if (!library.prefix.empty() && tracer.starts_with(library.prefix)) return library.form;
  return ReproForm::cpp_plain;
}

std::string repro_file_name(ReproForm form) {
  switch (form) {
    case ReproForm::js_three: return "repro.mjs";
    case ReproForm::c_librt:
    case ReproForm::c_plugin: return "repro.c";
    case ReproForm::python_proof: return "proof.py";
    case ReproForm::obj: return "scene.obj";
    case ReproForm::ply: return "scene.ply";
    case ReproForm::asc: return "scene.asc";
    default: return "repro.cpp";
  }
}

std::string to_repro(const Case& what, ReproForm form, std::string_view tracer) {
  const std::string_view asked = asked_by(form, what, tracer);
  switch (form) {
    case ReproForm::cpp_plain: return cpp_plain(what, asked);
    case ReproForm::cpp_embree: return cpp_embree(what, asked);
    case ReproForm::cpp_cgal: return cpp_cgal(what, asked);
    case ReproForm::cpp_bullet: return cpp_bullet(what, asked);
    case ReproForm::cpp_glm: return cpp_glm(what, asked);
    case ReproForm::js_three: return js_three(what);
    case ReproForm::c_librt: return c_librt(what, asked);
    case ReproForm::c_plugin: return c_plugin(what, tracer);
    case ReproForm::python_proof:
      return what.bag.triangles.size() == 1 ? python_proof(what, tracer) : python_bag_proof(what, tracer);
    case ReproForm::obj: return obj(what);
    case ReproForm::ply: return ply(what);
    case ReproForm::asc: return asc(what);
  }
  return {};
}

}  // namespace plumbline
