"""Who may include whom: case -> oracle | float_tracer -> analysis -> repros -> findings -> fuzz -> cli, one way only. The
oracle and the tracers share no arithmetic, so neither includes the other; meshes see the oracle, and no tracer."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAY_INCLUDE = {
    "case": {"case"},
    "oracle": {"case", "oracle"},
    "mesh": {"case", "oracle", "mesh"},
    "float_tracer": {"case", "float_tracer"},
    "analysis": {"case", "oracle", "mesh", "float_tracer", "analysis"},
    "repros": {"case", "oracle", "mesh", "float_tracer", "analysis", "repros"},
    "findings": {"case", "oracle", "mesh", "float_tracer", "analysis", "repros", "findings"},
    "fuzz": {"case", "oracle", "mesh", "float_tracer", "analysis", "repros", "findings", "fuzz"},
    "cli": {"case", "oracle", "mesh", "float_tracer", "analysis", "repros", "findings", "fuzz", "cli"},
    "install": {"case", "oracle"},
}
# Libraries that these folders alone may name: what is exact stays in the oracle and in what it is compared with, what
# parses stays at the border.
ONLY_IN = {
    r"gmp(xx)?\.h": {"oracle", "analysis/bench/rivals"},
    r"c?glm/.*": {"float_tracer/adapters"},
    r"graphene.*\.h": {"float_tracer/adapters"},
    r"(BulletCollision|LinearMath)/.*": {"float_tracer/adapters"},
    r"ode/.*": {"float_tracer/adapters"},
    r"(gts|glib)\.h": {"float_tracer/adapters"},
    r"(embree\d|libwildmagic|irrlicht|OGRE|ignition)/.*": {"float_tracer/adapters"},
    r"vtk\w+\.h": {"float_tracer/adapters"},
    r"brlcad/.*": {"float_tracer/adapters"},
    r"simdjson\.h": {"case"},
    r"nlohmann/.*": {"findings", "fuzz", "fuzz/bench"},
    r"sqlite3\.h": {"findings"},
    r"CLI/.*": {"cli", "fuzz"},
    r"CGAL/AABB_.*": {"float_tracer/gpl"},
    r"CGAL/.*": {"mesh", "float_tracer/adapters", "float_tracer/gpl", "analysis/bench/rivals"},
    r"boost/.*": {"analysis/bench/rivals"},
    r"g(test|mock)/.*": {"install"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.S)  # the text of a program, in repros/


def violations(folder, text):
    found = []
    for kind, name in INCLUDE.findall(RAW_STRING.sub("", text)):
        if kind == '"':
            target = name.split("/")[0]
            if target not in MAY_INCLUDE[folder.split("/")[0]]:
                found.append(f'{folder}/ includes "{name}"')
        for pattern, homes in ONLY_IN.items():
            if re.fullmatch(pattern, name) and folder not in homes:
                found.append(f"{folder}/ includes <{name}>")
    return found


def sources(folder):
    return [p for p in sorted((ROOT / folder).rglob("*")) if p.suffix in {".h", ".cpp"}]


class Layering(unittest.TestCase):
    def test_includes_go_one_way(self):
        found = []
        for folder in MAY_INCLUDE:
            for path in sources(folder):
                name = path.relative_to(ROOT)
                found += [f"{name}: {v}" for v in violations(name.parent.as_posix(), path.read_text())]
        self.assertEqual(found, [])

    def test_every_folder_has_sources(self):
        for folder in ("case", "oracle", "float_tracer", "analysis", "findings", "cli"):
            self.assertTrue(sources(folder), folder)

    def test_the_check_sees_a_violation(self):
        self.assertTrue(violations("oracle", '#include "float_tracer/tracer.h"\n'))
        self.assertTrue(violations("float_tracer", '  #  include "oracle/truth.h"\n'))
        self.assertTrue(violations("case", "#include <gmpxx.h>\n"))
        self.assertTrue(violations("analysis/bench", "#include <CGAL/Gmpq.h>\n"))
        self.assertTrue(violations("float_tracer/adapters", "#include <CGAL/AABB_tree.h>\n"))
        self.assertFalse(violations("analysis/bench/rivals", "#include <CGAL/Gmpq.h>\n"))
        self.assertFalse(violations("analysis", '#include "oracle/truth.h"\n#include <vector>\n'))
        self.assertTrue(violations("repros", '#include <glm/glm.hpp>\nx = R"(y)";\n'))
        self.assertFalse(violations("repros", 'x = R"py(\n#include <glm/glm.hpp>\n)")py";\n'))

    def test_headers_have_a_contract_on_top(self):
        for folder in MAY_INCLUDE:
            for path in sources(folder):
                if path.suffix == ".h":
                    self.assertTrue(path.read_text().startswith("// "), f"{path.relative_to(ROOT)} opens without its contract")


if __name__ == "__main__":
    unittest.main()
