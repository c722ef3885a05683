# BRL-CAD's librt: Brlcad_FOUND, Brlcad_VERSION and the target Brlcad::librt. One that is incomplete or too new for the
# adapter counts as not found.
#
# BRLCAD_ROOT is the folder it was installed to; without it, those of its own installers are tried. System folders are
# not searched: the C library has a librt of its own. BRL-CAD's headers include tcl.h, a copy of theirs or Debian's
# (tcl-dev).
set(BRLCAD_ROOT "" CACHE PATH "Where BRL-CAD is installed; empty: /usr/brlcad")
if(BRLCAD_ROOT)
  set(Brlcad_places ${BRLCAD_ROOT})
else()
  file(GLOB Brlcad_places LIST_DIRECTORIES true /usr/brlcad/rel-* /usr/brlcad/stable)
  list(SORT Brlcad_places COMPARE NATURAL ORDER DESCENDING)
  list(APPEND Brlcad_places /usr/brlcad)
endif()

find_path(Brlcad_INCLUDE_DIR brlcad/raytrace.h PATHS ${Brlcad_places} PATH_SUFFIXES include NO_DEFAULT_PATH)
find_library(Brlcad_RT_LIBRARY NAMES rt librt PATHS ${Brlcad_places} PATH_SUFFIXES lib NO_DEFAULT_PATH)
find_library(Brlcad_BU_LIBRARY NAMES bu libbu PATHS ${Brlcad_places} PATH_SUFFIXES lib NO_DEFAULT_PATH)
find_path(Brlcad_TCL_INCLUDE_DIR tcl.h PATHS ${Brlcad_places} PATH_SUFFIXES include NO_DEFAULT_PATH)
find_path(Brlcad_TCL_INCLUDE_DIR tcl.h PATH_SUFFIXES tcl8.6 tcl)
find_path(Brlcad_OPENNURBS_INCLUDE_DIR opennurbs.h PATHS ${Brlcad_places} PATH_SUFFIXES include/openNURBS
          NO_DEFAULT_PATH)
mark_as_advanced(Brlcad_INCLUDE_DIR Brlcad_RT_LIBRARY Brlcad_BU_LIBRARY Brlcad_TCL_INCLUDE_DIR
                 Brlcad_OPENNURBS_INCLUDE_DIR)

if(Brlcad_INCLUDE_DIR AND EXISTS ${Brlcad_INCLUDE_DIR}/brlcad/brlcad_config.h)
  file(STRINGS ${Brlcad_INCLUDE_DIR}/brlcad/brlcad_config.h Brlcad_lines
       REGEX "define BRLCAD_VERSION_(MAJOR|MINOR|PATCH) ")
  string(REGEX REPLACE "[^0-9;]" "" Brlcad_numbers "${Brlcad_lines}")
  list(JOIN Brlcad_numbers . Brlcad_VERSION)
endif()

set(Brlcad_INCLUDE_DIRS ${Brlcad_INCLUDE_DIR} ${Brlcad_INCLUDE_DIR}/brlcad)
foreach(folder ${Brlcad_TCL_INCLUDE_DIR} ${Brlcad_OPENNURBS_INCLUDE_DIR})
  if(folder)
    list(APPEND Brlcad_INCLUDE_DIRS ${folder})
  endif()
endforeach()

# Whether it has the functions of 7.24 that the adapter calls, and all that its headers and libraries ask for.
if(Brlcad_INCLUDE_DIR AND Brlcad_RT_LIBRARY AND Brlcad_BU_LIBRARY)
  include(CheckCXXSourceCompiles)
  include(CMakePushCheckState)
  cmake_push_check_state(RESET)
  set(CMAKE_REQUIRED_INCLUDES ${Brlcad_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${Brlcad_RT_LIBRARY} ${Brlcad_BU_LIBRARY})
  set(CMAKE_REQUIRED_FLAGS "-w -Wno-register")  # as in a system header
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_source_compiles([[
    #include <brlcad/raytrace.h>
    #include <brlcad/rtgeom.h>
    int main() {
      db_i* database = db_open_inmem();
      rt_i* instance = rt_new_rti(database);
      wdb_export(database->dbi_wdbp, "bag", nullptr, ID_BOT, 1.0);
      rt_free_rti(instance);
      wdb_close(database->dbi_wdbp);
      return bu_setjmp_valid;
    }]] Brlcad_USABLE)
  cmake_pop_check_state()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Brlcad REQUIRED_VARS Brlcad_RT_LIBRARY Brlcad_BU_LIBRARY Brlcad_INCLUDE_DIR Brlcad_USABLE VERSION_VAR Brlcad_VERSION)

if(Brlcad_FOUND AND NOT TARGET Brlcad::librt)
  add_library(Brlcad::librt INTERFACE IMPORTED)
  target_include_directories(Brlcad::librt SYSTEM INTERFACE ${Brlcad_INCLUDE_DIRS})
  target_link_libraries(Brlcad::librt INTERFACE ${Brlcad_RT_LIBRARY} ${Brlcad_BU_LIBRARY})
  target_compile_definitions(Brlcad::librt INTERFACE PLUMBLINE_BRLCAD_VERSION="${Brlcad_VERSION}")
endif()
