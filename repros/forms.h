// A function for each form of repro.h, or group of forms. Private to repros/.
#pragma once
#include <string>
#include <string_view>

#include "case/case.h"

namespace plumbline {

// Programs. `tracer` is one that the form can ask (repro.cpp sees to it).
std::string cpp_plain(const Case& what, std::string_view tracer);
std::string cpp_embree(const Case& what, std::string_view tracer);
std::string cpp_cgal(const Case& what, std::string_view tracer);
std::string cpp_bullet(const Case& what, std::string_view tracer);
std::string cpp_glm(const Case& what, std::string_view tracer);
std::string js_three(const Case& what);
std::string c_librt(const Case& what, std::string_view tracer);
std::string c_plugin(const Case& what, std::string_view tracer);

/// `tracer` may be any, or empty.
std::string python_proof(const Case& what, std::string_view tracer);
std::string python_bag_proof(const Case& what, std::string_view tracer);  ///< of several triangles

// Scenes: any number of triangles.
std::string obj(const Case& what);
std::string ply(const Case& what);
std::string asc(const Case& what);

}  // namespace plumbline
