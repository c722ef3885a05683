// A finding as a program, a proof or a scene that stands alone: what a maintainer can run without anything of ours.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "case/case.h"

namespace plumbline {

/// Programs exit with 1 while the library under test gets the case wrong, with 0 once it doesn't, with 2 if they
/// could not ask. A proof exits with 0 if it proves. obj, ply and asc are scenes.
enum class ReproForm : unsigned char {
  cpp_plain, cpp_embree, cpp_cgal, cpp_bullet, cpp_glm, js_three, c_librt, c_plugin, python_proof, obj, ply, asc
};
inline constexpr std::array<std::string_view, 12> repro_form_names = {
    "cpp-plain", "cpp-embree", "cpp-cgal", "cpp-bullet", "cpp-glm", "js-three", "c-librt", "c-plugin", "python-proof",
    "obj",       "ply",        "asc"};
constexpr std::string_view name(ReproForm f) { return repro_form_names[static_cast<unsigned>(f)]; }

/// The text of the file. `tracer` is who gets it wrong: its rules are the program's, where the form can follow them;
/// of another library, or empty: the form's own default. Throws InputError where the case can't be told in that form
/// (several triangles, numbers that aren't of the library's precision, a tracer that this build hasn't or that
/// cpp_plain can't write out), naming the case and the fix.
std::string to_repro(const Case& what, ReproForm form, std::string_view tracer);

/// The form that suits a tracer: cpp_embree for embree_robust_avx2; cpp_plain where none is nearer.
ReproForm repro_form_of(std::string_view tracer);

/// "repro.cpp", "proof.py", "scene.obj"
std::string repro_file_name(ReproForm form);

}  // namespace plumbline
