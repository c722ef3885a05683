// What stands before CGAL's readers. They trust a file: they allocate what a header promises, take no notice of words
// they don't know, and some headers crash them (docs/meshes.md lists what was found). So the form of each file is
// checked here first, and what they need not see is blanked: names, comments, colours, normals.
//
// What comes out is the same mesh in a form that CGAL 5.5 reads without harm. It still may name vertices that aren't
// there or have polygons of two corners; in a PLY coordinates may not be finite.
// Throws InputError with file and line (text) or item (binary).
#pragma once
#include <string>

namespace plumbline {

std::string vetted_obj(std::string bytes, const std::string& name);
std::string vetted_ply(std::string bytes, const std::string& name);
std::string vetted_stl(std::string bytes, const std::string& name);

}  // namespace plumbline
