// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset.hpp"

#include <chrono>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "error_of.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string head = "name: toys\nunits: mm\nmax_distance: 50\n";

class DataSetFile : public ::testing::Test {
protected:
  void SetUp() override {
    for (const std::string folder : {"sets", "views", "sets/scenes"}) {
      std::filesystem::create_directory(folder_.path(folder));
    }
    Cloud cloud;
    cloud.width = 1;
    cloud.points = {{1000, 2000, 3000}};
    for (const std::string name : {"views/duck0.pcd", "views/duck1.pcd", "sets/scenes/a.pcd", "sets/scenes/b.pcd"}) {
      writeCloud(folder_.path(name), cloud);
    }
  }

  DataSet load(const std::string& text) const {
    writeFileAtomically(file(), text);
    return loadDataSet(file());
  }
  std::string refusal(const std::string& text, ErrorCode code = ErrorCode::bad_data) const {
    return test::errorOf(code, [&] { load(text); });
  }
  std::string file() const { return folder_.path("sets/toys.yaml"); }
  /// A data set of one scene with one duck, whose entry has the given further keys.
  std::string withDuck(const std::string& keys) const {
    return head + "scenes:\n  - name: a\n    cloud: scenes/a.pcd\n    objects:\n      - object: duck\n        " + keys;
  }

  test::TemporaryFolder folder_;
};

TEST_F(DataSetFile, SymmetriesAndDiameterAreInUnitsOfTheEntry) {
  const std::string lists =
      "diameter: 120, symmetries_discrete: [{pose: [-1, 0, 0, 10, 0, -1, 0, 20, 0, 0, 1, 0, 0, 0, 0, 1]}], "
      "symmetries_continuous: [{axis: [0, 0, 2], offset: [10, 20, 0]}, {axis: [1, 0, 0]}]";
  const DataSet data_set = load(head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: mesh, " + lists +
                                "}\n  - {object: swan, cloud: ../views/duck1.pcd, kind: mesh, units: cm, " + lists +
                                "}\n  - {object: hen, cloud: ../views/duck1.pcd, kind: mesh}\n");
  for (const auto& [entry, unit] :
       {std::make_pair(data_set.training[0], 0.001), std::make_pair(data_set.training[1], 0.01)}) {
    EXPECT_DOUBLE_EQ(*entry.diameter, 120 * unit);
    ASSERT_TRUE(entry.symmetries);
    ASSERT_EQ(entry.symmetries->discrete.size(), 1u);
    const Eigen::Vector3d moved = entry.symmetries->discrete[0] * Eigen::Vector3d(unit, 2 * unit, 3 * unit);
    EXPECT_NEAR((moved - unit * Eigen::Vector3d(9, 18, 3)).norm(), 0, 1e-12);
    ASSERT_EQ(entry.symmetries->continuous.size(), 2u);
    EXPECT_EQ(entry.symmetries->continuous[0].direction, Eigen::Vector3d(0, 0, 1));
    EXPECT_NEAR((entry.symmetries->continuous[0].position - unit * Eigen::Vector3d(10, 20, 0)).norm(), 0, 1e-12);
    EXPECT_EQ(entry.symmetries->continuous[1].position, Eigen::Vector3d(0, 0, 0));
  }
  EXPECT_FALSE(data_set.training[2].diameter);
  EXPECT_FALSE(data_set.training[2].symmetries);
}

TEST_F(DataSetFile, SymmetriesAndDiameterThatCannotBeAreRefused) {
  const auto refused = [&](const std::string& keys) {
    return refusal(head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: mesh, " + keys + "}\n");
  };
  EXPECT_THAT(refused("diameter: 0"), HasSubstr("toys.yaml:5: 'diameter' of a training cloud must be greater than 0"));
  EXPECT_THAT(refused("symmetries_discrete: [{pose: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}]"),
              HasSubstr("'pose' of a discrete symmetry is not rigid"));
  EXPECT_THAT(refused("symmetries_continuous: [{axis: [0, 0, 0]}]"),
              HasSubstr("'axis' of a continuous symmetry must have a length"));
  EXPECT_THAT(refused("symmetries_continuous: [{offset: [0, 0, 0]}]"), HasSubstr("needs the key 'axis'"));
  EXPECT_THAT(refused("symmetries_discrete: [1]"), HasSubstr("a discrete symmetry must be a map"));
}

TEST_F(DataSetFile, IsReadInMetres) {
  const DataSet data_set = load(head + R"(training:
  - {object: duck, cloud: ../views/./duck0.pcd, kind: view}
  - {object: swan, cloud: ../views/duck1.pcd, kind: model}
scenes:
  - name: a
    cloud: scenes/a.pcd
    objects:
      - object: duck
        position: [100, 0, 500]
        reference: ../views/duck0.pcd
        pose: [0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1]
        visibility: 0.7
        points: 812
    ignore: [swan]
  - {name: b, cloud: scenes/b.pcd, objects: []}
tests:
  - {object: duck, cloud: ../views/duck1.pcd}
)");
  EXPECT_EQ(data_set.name, "toys");
  EXPECT_EQ(data_set.scale, 0.001);
  EXPECT_DOUBLE_EQ(data_set.max_distance, 0.05);
  EXPECT_THAT(data_set.warnings, IsEmpty());

  ASSERT_EQ(data_set.training.size(), 2u);
  EXPECT_EQ(data_set.training[0].object, "duck");
  EXPECT_EQ(data_set.training[0].source, "../views/duck0.pcd");
  EXPECT_EQ(data_set.training[0].path, folder_.path("views/duck0.pcd"));
  EXPECT_EQ(data_set.training[0].kind, ViewKind::view);
  EXPECT_EQ(data_set.training[1].kind, ViewKind::model);

  ASSERT_EQ(data_set.scenes.size(), 2u);
  const Scene& scene = data_set.scenes[0];
  EXPECT_EQ(scene.path, folder_.path("sets/scenes/a.pcd"));
  EXPECT_THAT(scene.ignore, ElementsAre("swan"));
  ASSERT_EQ(scene.objects.size(), 1u);
  const GroundTruth& truth = scene.objects[0];
  EXPECT_TRUE(truth.position.isApprox(Eigen::Vector3d(0.1, 0, 0.5)));
  EXPECT_EQ(truth.reference, data_set.training[0].source);
  EXPECT_EQ(truth.visibility, 0.7);
  EXPECT_EQ(truth.points, 812u);
  ASSERT_TRUE(truth.T_scene_reference);
  EXPECT_TRUE((*truth.T_scene_reference * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0.01, 1.02, 0.03), 1e-12));
  EXPECT_THAT(data_set.scenes[1].objects, IsEmpty());

  ASSERT_EQ(data_set.tests.size(), 1u);
  EXPECT_EQ(data_set.tests[0].object, "duck");
}

TEST_F(DataSetFile, LoadsTrainingCloudsWhenTheirTurnComes) {
  const auto samples =
      trainingSamples(load(head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: model}\n"));
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].object, "duck");
  EXPECT_EQ(samples[0].source, "../views/duck0.pcd");
  EXPECT_EQ(samples[0].kind, ViewKind::model);
  const Cloud cloud = samples[0].load();
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_TRUE(cloud.points[0].isApprox(Eigen::Vector3f(1, 2, 3)));
}

TEST_F(DataSetFile, UnknownKeysAreRefusedWithTheNearest) {
  EXPECT_EQ(refusal(head + "scene: []\n"), file() + ":4: unknown key 'scene' in the data set; did you mean 'scenes'?");
  EXPECT_EQ(refusal(head + "training:\n  - object: duck\n    clowd: x.pcd\n"),
            file() + ":6: unknown key 'clowd' in a training cloud; did you mean 'cloud'?");
  EXPECT_THAT(refusal(withDuck("visible: 1")), HasSubstr(":9: unknown key 'visible' in an object of scene 'a'; did you "
                                                         "mean 'visibility'?"));
  EXPECT_THAT(refusal(head + "name: again\n"), HasSubstr(":4: key 'name' stands twice"));
}

TEST_F(DataSetFile, UnknownUnitsAndImpossibleLengthsAreRefused) {
  for (const std::string unit : {"ell", "Mm", "-1", "0", "1e30", "nan"}) {
    EXPECT_EQ(refusal("name: toys\nunits: " + unit + "\n"),
              file() + ":2: 'units' of the data set is '" + unit +
                  "': use m, cm, mm, inch or a number of metres, the unit of every length");
  }
  EXPECT_THAT(refusal("name: toys\nunits: m\nmax_distance: 1e30\nscenes: [1]\n"), HasSubstr("must be at most 100 m"));
  EXPECT_THAT(refusal("name: toys\n"), HasSubstr("the data set needs the key 'units'"));
}

TEST_F(DataSetFile, MissingCloudsAreFoundAtOnce) {
  const std::string message =
      refusal(head + "scenes:\n  - {name: a, cloud: scenes/none.pcd, objects: []}\n", ErrorCode::bad_file);
  EXPECT_THAT(message, HasSubstr(file() + ":5: cloud '" + folder_.path("sets/scenes/none.pcd") + "' does not exist"));
  EXPECT_THAT(message, HasSubstr("relative to the data set file"));
  refusal(head + "training:\n  - {object: duck, cloud: none.pcd, kind: view}\n", ErrorCode::bad_file);
  refusal(head + "tests:\n  - {object: duck, cloud: none.pcd}\n", ErrorCode::bad_file);
}

TEST_F(DataSetFile, AMissingOrForeignFileIsNamed) {
  const std::string nowhere = folder_.path("nowhere.yaml");
  EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { loadDataSet(nowhere); }), HasSubstr(nowhere));
  EXPECT_THAT(refusal("name: [1, 2\n", ErrorCode::bad_file), HasSubstr("not a YAML file"));
  EXPECT_THAT(refusal(""), HasSubstr("must be a map"));
  EXPECT_THAT(refusal("- a\n- b\n"), HasSubstr("must be a map"));
  EXPECT_THAT(refusal(head + "---\n" + head, ErrorCode::bad_file), HasSubstr("a second document"));
  EXPECT_THAT(refusal(head), HasSubstr("needs 'training', 'scenes' or 'tests'"));
}

TEST_F(DataSetFile, PosesMustBeRigid) {
  const std::string position = "position: [0, 0, 1]\n        ";
  EXPECT_THAT(refusal(withDuck(position + "pose: [1, 2, 3]\n")),
              HasSubstr(":10: 'pose' of an object of scene 'a' must be a list of 16 finite numbers"));
  EXPECT_THAT(refusal(withDuck(position + "pose: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, .nan, 0, 0, 0, 1]\n")),
              HasSubstr("16 finite numbers"));
  EXPECT_THAT(refusal(withDuck(position + "pose: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1]\n")),
              HasSubstr("must end with 0, 0, 0, 1"));
  for (const std::string bad : {"2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0", "-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0",
                                "1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0"}) {
    EXPECT_THAT(refusal(withDuck(position + "pose: [" + bad + ", 0, 0, 0, 1]\n")), HasSubstr("is not rigid"));
  }
}

TEST_F(DataSetFile, ARoundedRotationIsMadeExact) {
  const DataSet data_set =
      load(withDuck("position: [0, 0, 1]\n        reference: ../views/duck0.pcd\n        pose: [0.707, -0.707, 0, 0, "
                    "0.707, 0.707, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"));
  const Eigen::Matrix3d rotation = data_set.scenes[0].objects[0].T_scene_reference->linear();
  EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(rotation(0, 0), std::sqrt(0.5), 1e-12);
}

TEST_F(DataSetFile, ValuesOfTheWrongKindAreRefused) {
  EXPECT_THAT(refusal(withDuck("position: [0, 0]\n")), HasSubstr("must be a list of 3 finite numbers"));
  EXPECT_THAT(refusal(withDuck("visibility: 0.5\n")), HasSubstr("needs the key 'position'"));
  EXPECT_THAT(refusal(withDuck("position: [0, 0, 1]\n        visibility: 70\n")), HasSubstr("must lie in [0, 1]"));
  EXPECT_THAT(refusal(withDuck("position: [0, 0, 1]\n        points: 7.5\n")), HasSubstr("must be a count"));
  EXPECT_THAT(refusal("name: toys\nunits: m\nmax_distance: far\nscenes: [1]\n"), HasSubstr("must be a finite number"));
  EXPECT_THAT(refusal("name: toys\nunits: m\nmax_distance: 0\nscenes: [1]\n"), HasSubstr("greater than 0 m"));
  EXPECT_THAT(refusal("name: toys\nunits: m\nscenes: [1]\n"), HasSubstr("needs the key 'max_distance'"));
  EXPECT_THAT(refusal(head + "scenes: 3\n"), HasSubstr("'scenes' of the data set must be a list"));
  EXPECT_THAT(
      refusal(head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: photo}\n"),
      HasSubstr(
          "'kind' of a training cloud is 'photo': use view (2.5-D, seen from the camera), model (full 3-D) or mesh"));
}

TEST_F(DataSetFile, ScenesNeedNamesOfTheirOwn) {
  EXPECT_THAT(refusal(head + "scenes:\n  - {name: a, cloud: scenes/a.pcd}\n  - {name: a, cloud: scenes/b.pcd}\n"),
              HasSubstr(":6: 'name' of a scene is 'a', which an earlier scene has"));
}

TEST_F(DataSetFile, OtherEncodingsAreRefusedWithTheLine) {
  const std::string training = "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: view}\n";
  EXPECT_EQ(load("\xef\xbb\xbf" + head + training).training.at(0).object, "duck");
  EXPECT_EQ(load("name: m\xc3\xbcll\nunits: mm\n" + training).name, "m\xc3\xbcll");
  EXPECT_EQ(
      refusal("units: mm\nname: m\xfcll\n" + training, ErrorCode::bad_file),
      file() + ":2: the byte 0xfc is not UTF-8: save the file as UTF-8, or convert it by iconv -f LATIN1 -t UTF-8");
  for (const std::string& mark : {std::string("\xff\xfe", 2), std::string("\xfe\xff", 2), std::string()}) {
    std::string wide = mark;
    for (const char c : head + training) wide += mark == "\xfe\xff" ? std::string({'\0', c}) : std::string({c, '\0'});
    EXPECT_THAT(refusal(wide, ErrorCode::bad_file),
                HasSubstr(":1: the file is UTF-16 or UTF-32, not UTF-8: save it as UTF-8"));
  }
  EXPECT_THAT(refusal(head + std::string("#\0\n", 3) + training, ErrorCode::bad_file),
              HasSubstr(":4: not a text file"));
}

TEST_F(DataSetFile, ATabIsCalledATab) {
  for (const std::string text : {"training:\n\t- {object: duck, cloud: ../views/duck0.pcd, kind: view}\n",
                                 "training:\n  - object: duck\n\tcloud: ../views/duck0.pcd\n", "\ttraining: []\n"}) {
    EXPECT_THAT(refusal(head + text, ErrorCode::bad_file),
                HasSubstr(": a tab, which is no indentation in YAML: use spaces"));
  }
  EXPECT_THAT(refusal(head + "training:\n  - object: duck\n\tcloud: x\n", ErrorCode::bad_file),
              HasSubstr("toys.yaml:6: "));
  EXPECT_EQ(
      load("name:\ttoys\nunits: mm\ntraining:\n  - {object: duck,\tcloud: ../views/duck0.pcd, kind: view}\n").name,
      "toys");
}

TEST_F(DataSetFile, NamesMustBeFitToBeShown) {
  const auto with = [&](const std::string& name) {
    return refusal(head + "training:\n  - {object: " + name + ", cloud: ../views/duck0.pcd, kind: view}\n");
  };
  EXPECT_THAT(with("\"du\\x1b[31mck\""),
              HasSubstr(":5: 'object' of a training cloud is 'du\\x1b[31mck', which is refused: "
                        "it contains a control character"));
  EXPECT_THAT(with("\"du\\0ck\""), HasSubstr("control character"));
  EXPECT_THAT(with("\"du\\nck\""), HasSubstr("control character"));
  EXPECT_THAT(with(std::string(201, 'x')), HasSubstr("it has 201 bytes; use at most 200"));
  EXPECT_LT(with(std::string(10000, 'x')).size(), 500u);
  EXPECT_THAT(refusal("name: \"a\\tb\"\nunits: mm\n"),
              HasSubstr("'name' of the data set is 'a\\tb', which is refused"));
}

TEST_F(DataSetFile, UnknownKeysThatResembleNoneAreAnsweredWithAList) {
  EXPECT_EQ(
      refusal(head + "banana: []\n"),
      file() +
          ":4: unknown key 'banana' in the data set; there are: name, units, max_distance, training, scenes, tests");
}

/// A set of simulated scenes may have tens of thousands of them; the time for each must not grow with their number.
TEST_F(DataSetFile, ManyScenesTakeTimeInProportion) {
  const auto seconds = [&](int count) {
    std::string text = head + "scenes:\n";
    for (int i = 0; i < count; ++i) text += "  - {name: s" + std::to_string(i) + ", cloud: scenes/a.pcd}\n";
    test::writeFile(file(), text);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(loadDataSet(file()).scenes.size(), std::size_t(count));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double few = seconds(1000);
  EXPECT_LT(seconds(8000), 8 * 4 * few + 0.5);  // were it quadratic: 64 times as long
}

TEST_F(DataSetFile, IsReadBeforeItIsWritten) {
  const std::string text = head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: view}\n";
  EXPECT_EQ(parseDataSet(text, file()).training.at(0).path, folder_.path("views/duck0.pcd"));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(DataSetFile, WarnsOfWhatIsOdd) {
  const std::string pose = "pose: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n";
  const DataSet no_reference = load(withDuck("position: [0, 0, 1]\n        " + pose));
  EXPECT_THAT(no_reference.warnings, ElementsAre(HasSubstr("toys.yaml:10: a pose without 'reference'")));
  const DataSet missing = load(withDuck("position: [0, 0, 1]\n        reference: gone.pcd\n"));
  EXPECT_THAT(missing.warnings, ElementsAre(HasSubstr("gone.pcd' does not exist")));
  const DataSet ignored = load(withDuck("position: [0, 0, 1]\n    ignore: [duck]\n"));
  EXPECT_THAT(ignored.warnings, ElementsAre(HasSubstr("'duck' of scene 'a' is ignored although it has ground truth")));
}

TEST_F(DataSetFile, HoldsThePlanesOfViews) {
  const auto with = [&](const std::string& kind, const std::string& plane) {
    return head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: " + kind + ", plane: " + plane +
           "}\n";
  };
  const auto plane = load(with("view", "[0, -0.6, -0.8, 750]")).training.at(0).plane;
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->normal().isApprox(Eigen::Vector3d(0, -0.6, -0.8), 1e-9));
  EXPECT_NEAR(plane->offset(), 0.75, 1e-9);
  EXPECT_THAT(refusal(with("model", "[0, 0, 1, 0]")), HasSubstr("only of use for views"));
  EXPECT_THAT(refusal(with("view", "[0, 0, 2, 0]")), HasSubstr("unit vector"));
  EXPECT_THAT(refusal(with("view", "[0, 0, 1]")), HasSubstr("plane"));
}

TEST_F(DataSetFile, HoldsThePosesOfViews) {
  const auto with = [&](const std::string& kind, const std::string& pose) {
    return head + "training:\n  - {object: duck, cloud: ../views/duck0.pcd, kind: " + kind + ", cloud_pose: " + pose +
           "}\n";
  };
  const auto pose =
      load(with("view", "[0, -1, 0, 500, 1, 0, 0, 0, 0, 0, 1, -1000, 0, 0, 0, 1]")).training.at(0).T_fixed_cloud;
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->translation().isApprox(Eigen::Vector3d(0.5, 0, -1), 1e-9));
  EXPECT_TRUE((pose->linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
  EXPECT_THAT(refusal(with("model", "[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]")),
              HasSubstr("only of use for views"));
  EXPECT_THAT(refusal(with("view", "[2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]")), HasSubstr("rigid"));
  EXPECT_THAT(refusal(with("view", "[1, 0, 0, 2.0e+7, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]")), HasSubstr("10 km"));
}

TEST_F(DataSetFile, NamesObjectsThatWereNeverTrained) {
  const DataSet data_set =
      load(head +
           "scenes:\n  - name: a\n    cloud: scenes/a.pcd\n    objects:\n"
           "      - {object: swan, position: [0, 0, 1]}\n      - {object: duck, position: [0, 0, 1]}\n"
           "      - {object: swan, position: [0, 0, 2]}\n");
  EXPECT_THAT(untrainedObjects(data_set, {"duck", "frog"}), ElementsAre("swan"));
  EXPECT_THAT(untrainedObjects(data_set, {"duck", "swan"}), IsEmpty());
}

}  // namespace
}  // namespace sks
