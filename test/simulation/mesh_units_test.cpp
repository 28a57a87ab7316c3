// SPDX-License-Identifier: BSD-3-Clause
// The size of meshes: the unit that the file states, that of the data set, or the one given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/dataset.hpp"
#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"
#include "simulation/mesh_sampler.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A COLLADA file of the box. @param unit the element, or nothing @param scale units per metre
std::string boxDae(const std::string& unit, float scale, const std::string& up = "Z_UP") {
  std::string numbers, indices;
  for (const Eigen::Vector3f& c : test::boxCorners()) {
    for (int axis = 0; axis < 3; ++axis) numbers += std::to_string(scale * c[axis]) + " ";
  }
  for (const auto& triangle : test::boxTriangles()) {
    for (const int corner : triangle) indices += std::to_string(corner) + " ";
  }
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         unit + "<up_axis>" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="72">)" +
         numbers + R"(</float_array><technique_common>
<accessor source="#pa" count="24" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         indices + R"(</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

class MeshUnits : public test::MeshFileTest {
protected:
  /// Size of the mesh that a data set trains from, in millimetres, by its boxes.
  Eigen::Vector3f trainedSize(const std::string& units, const std::string& entry) {
    const std::string file =
        write("set.yaml", "name: a\nunits: " + units + "\ntraining:\n  - {object: box, kind: mesh, " + entry + "}\n");
    warnings_.clear();
    const MeshSampler sampler = meshSampler(MeshTraining(), [this](const std::string& w) { warnings_.push_back(w); });
    return 1000 * trainingSamples(loadDataSet(file), sampler).at(0).box->sizes();
  }
  static void expectBox(const Eigen::Vector3f& size) {
    EXPECT_TRUE(size.isApprox(1000 * test::box_size, 1e-4f)) << size;
  }

  std::vector<std::string> warnings_;
};

struct Unit {
  const char* element;
  float per_metre;
};
const std::vector<Unit> dae_units = {{"<unit name=\"millimeter\" meter=\"0.001\"/>", 1000},
                                     {"<unit meter='0.01' name='centimeter'/>", 100},
                                     {"<unit name=\"inch\" meter=\"0.0254\"/>", 1 / 0.0254f},
                                     {"<unit name=\"meter\" meter=\"1\"/>", 1}};

TEST_F(MeshUnits, ColladaFilesHaveTheirOwn) {
  for (const Unit& unit : dae_units) {
    for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
      const std::string path = write("a.dae", boxDae(unit.element, unit.per_metre, up));
      for (const double given : {0.0, 0.001, 0.0254}) {
        const LoadedMesh loaded = loadMesh(path, given);
        test::expectPlainBox(loaded.mesh);
        EXPECT_TRUE(loaded.states_unit);
        EXPECT_EQ(loaded.up_axis, std::string(up) == "Z_UP" ? "" : up);
        EXPECT_THAT(loaded.warnings, IsEmpty());
      }
    }
    for (const char* of_set : {"m", "mm", "cm"}) {
      expectBox(trainedSize(of_set, "cloud: a.dae"));
      EXPECT_THAT(warnings_, IsEmpty());
    }
  }
}

TEST_F(MeshUnits, AColladaFileMayNotStateIt) {
  const std::string path = write("a.dae", boxDae("", 1000));
  EXPECT_FALSE(loadMesh(path).states_unit);
  test::expectPlainBox(loadMesh(path, 0.001).mesh);
  expectBox(trainedSize("mm", "cloud: a.dae"));
}

TEST_F(MeshUnits, OfTheDataSetOrOfItsEntry) {
  write("m.obj", test::boxObj(""));
  write("cm.obj", test::boxObj("", 100));
  write("mm.obj", test::boxObj("", 1000));
  write("inch.obj", test::boxObj("", 1 / 0.0254f));
  expectBox(trainedSize("m", "cloud: m.obj"));
  expectBox(trainedSize("cm", "cloud: cm.obj"));
  expectBox(trainedSize("mm", "cloud: mm.obj"));
  expectBox(trainedSize("inch", "cloud: inch.obj"));
  for (const char* of_set : {"m", "mm"}) {
    expectBox(trainedSize(of_set, "cloud: cm.obj, units: cm"));
    expectBox(trainedSize(of_set, "cloud: m.obj, units: m"));
    expectBox(trainedSize(of_set, "cloud: inch.obj, units: in"));
    expectBox(trainedSize(of_set, "cloud: mm.obj, units: 0.001"));
    EXPECT_THAT(warnings_, IsEmpty());
  }
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { trainedSize("m", "cloud: m.obj, units: ell"); }),
              HasSubstr("'units' of a training cloud is 'ell': use m, cm, mm, inch or a number of metres"));
}

TEST_F(MeshUnits, AUnitForAFileWithItsOwnIsAWarning) {
  write("a.dae", boxDae(dae_units[0].element, dae_units[0].per_metre));
  expectBox(trainedSize("mm", "cloud: a.dae, units: cm"));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.dae: it states its unit itself")));
}

TEST_F(MeshUnits, MillimetresAreRecognisedWithAWarning) {
  const std::string path = write("a.obj", test::boxObj("", 1000));
  const LoadedMesh loaded = loadMesh(path);
  test::expectPlainBox(loaded.mesh);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("a.obj: it measures 140 x 90 x 60 units, which are taken for "
                                                     "millimetres")));
}

TEST_F(MeshUnits, ImpossibleSizesAreRefusedInMillimetres) {
  const std::string path = write("a.obj", test::boxObj(""));
  EXPECT_THAT(refusal(path, 0.001), HasSubstr("it would be 0.1 x 0.1 x 0.1 mm large, and can be from 1 mm to 100 m"));
  EXPECT_THAT(refusal(path, 1000), HasSubstr("it would be 140000 x 90000 x 60000 mm large"));
}

}  // namespace
}  // namespace sks
