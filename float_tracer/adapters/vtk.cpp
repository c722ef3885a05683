#include "float_tracer/adapters/vtk.h"

#include <vtkAbstractCellLocator.h>
#include <vtkCellArray.h>
#include <vtkCellLocator.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkOBBTree.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkTriangle.h>
#include <vtkVersionMacros.h>

#include "case/finite.h"
#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

constexpr double tolerant = 1e-6;

// What a call fills in.
struct Found {
  double t = 0, point[3] = {}, parameters[3] = {};
  int sub_id = 0;

  Answer hit(std::uint32_t triangle) const {
    return {.outcome = Outcome::hit,
            .has_t = true,
            .has_uv = true,
            .triangle = triangle,
            .t = t,
            .u = parameters[0],
            .v = parameters[1]};
  }
};

class PreparedSegments : public PreparedBag {
 public:
  explicit PreparedSegments(const Bag& bag) : largest_(largest_coordinate(bag)) {
    for (const Triangle& t : bag.triangles) takes_ = takes_ && is_finite(t);
  }

  Query asked(const Ray& ray) override {
    const auto segment = segment_of(ray, largest_, Precision::binary64);
    return segment ? segment->query : Query(ray);
  }

 protected:
  bool takes() const { return takes_; }

 private:
  virtual Answer nearest(const double* from, const double* to) = 0;

  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto segment = segment_of(rays[i], largest_, Precision::binary64);
      if (!takes_ || !segment) {
        answers[i] = {.outcome = Outcome::fault};
        continue;
      }
      const double from[] = {segment->from.x, segment->from.y, segment->from.z},
                   to[] = {segment->to.x, segment->to.y, segment->to.z};
      answers[i] = nearest(from, to);
    }
  }

  double largest_;
  bool takes_ = true;
};

class PreparedCells final : public PreparedSegments {
 public:
  PreparedCells(const Bag& bag, double tolerance) : PreparedSegments(bag), tolerance_(tolerance) {
    for (const Triangle& t : bag.triangles) {
      const auto cell = vtkSmartPointer<vtkTriangle>::New();  // its points are binary64
      vtkIdType i = 0;
      for (const Vec3& vertex : {t.a, t.b, t.c}) cell->GetPoints()->SetPoint(i++, vertex.x, vertex.y, vertex.z);
      cells_.push_back(cell);
    }
  }

 private:
  Answer nearest(const double* from, const double* to) override {
    Answer best;
    for (std::uint32_t k = 0; k < cells_.size(); ++k) {
      Found found;
      if (!cells_[k]->IntersectWithLine(from, to, tolerance_, found.t, found.point, found.parameters, found.sub_id))
        continue;
      if (best.outcome != Outcome::hit || found.t < best.t) best = found.hit(k);
    }
    return best;
  }

  std::vector<vtkSmartPointer<vtkTriangle>> cells_;
  double tolerance_;
};

template <class Locator>
class PreparedLocator final : public PreparedSegments {
 public:
  explicit PreparedLocator(const Bag& bag) : PreparedSegments(bag), empty_(bag.triangles.empty()) {
    if (empty_ || !takes()) return;
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();  // float, unless told
    const vtkNew<vtkCellArray> cells;
    for (const Triangle& t : bag.triangles) {
      cells->InsertNextCell(3);
      for (const Vec3& vertex : {t.a, t.b, t.c})
        cells->InsertCellPoint(points->InsertNextPoint(vertex.x, vertex.y, vertex.z));
    }
    const vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->SetPolys(cells);
    locator_->SetDataSet(mesh);
    locator_->BuildLocator();
  }

 private:
  Answer nearest(const double* from, const double* to) override {
    if (empty_) return {};
    Found found;
    vtkIdType id = -1;
    if (!static_cast<vtkAbstractCellLocator&>(*locator_.Get())
             .IntersectWithLine(from, to, 0, found.t, found.point, found.parameters, found.sub_id, id, cell_))
      return {};
    return found.hit(static_cast<std::uint32_t>(id));
  }

  const vtkNew<Locator> locator_;
  const vtkNew<vtkGenericCell> cell_;
  bool empty_;
};

TracerInfo info(std::string name, std::string summary, std::string source, double slack) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .source = std::move(source),
          .package = "libvtk9-dev " VTK_VERSION,
          .contract = {.edges = EdgeRule::unspecified,
                       .t_min = EndRule::unspecified,
                       .t_max = EndRule::unspecified,
                       .coplanar = TouchRule::unspecified,
                       .degenerate = TouchRule::unspecified,
                       .slack_absolute = slack},
          .own_queries = true};
}

class CellTracer final : public Tracer {
 public:
  CellTracer(TracerInfo info, double tolerance) : Tracer(std::move(info)), tolerance_(tolerance) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedCells>(bag, tolerance_);
  }

 private:
  double tolerance_;
};

template <class Locator>
class LocatorTracer final : public Tracer {
 public:
  explicit LocatorTracer(TracerInfo info) : Tracer(searching(std::move(info))) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedLocator<Locator>>(bag);
  }

 private:
  static TracerInfo searching(TracerInfo info) {
    info.has_tree = true;
    return info;
  }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> vtk_tracers() {
  vtkObject::GlobalWarningDisplayOff();
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<CellTracer>(
      info("vtk_triangle", "VTK's triangle without tolerance", "vtkTriangle::IntersectWithLine", 0), 0));
  list.push_back(std::make_unique<CellTracer>(info("vtk_triangle_tolerant", "VTK's triangle with a tolerance of 1e-6",
                                                   "vtkTriangle::IntersectWithLine", tolerant),
                                              tolerant));
  list.push_back(std::make_unique<LocatorTracer<vtkOBBTree>>(
      info("vtk_obb_tree", "VTK's tree of oriented boxes, without tolerance", "vtkOBBTree::IntersectWithLine", 0)));
  list.push_back(std::make_unique<LocatorTracer<vtkCellLocator>>(
      info("vtk_cell_locator", "VTK's octree, without tolerance", "vtkCellLocator::IntersectWithLine", 0)));
  list.push_back(std::make_unique<LocatorTracer<vtkStaticCellLocator>>(info(
      "vtk_static_cell_locator", "VTK's grid, without tolerance", "vtkStaticCellLocator::IntersectWithLine", 0)));
  return list;
}

}  // namespace plumbline
