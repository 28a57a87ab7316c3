// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/codebook_edit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/codebook_file.hpp>

#include "error_of.hpp"
#include "io/codebook_layout.hpp"

namespace sks {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Word i stands at x = i and belongs to view i, which belongs to object i % 3; its descriptor is full of i.
Codebook toys() {
  Codebook codebook;
  codebook.name = "toys";
  codebook.descriptor_type = codebook.settings.descriptor.type = DescriptorType::shot;
  codebook.objects = {"mario", "frog", "duck"};
  std::vector<float> values;
  for (std::uint32_t i = 0; i < 6; ++i) {
    TrainingView view;
    view.object = i % 3;
    view.source = std::to_string(i);
    codebook.views.push_back(view);
    Codeword word;
    word.view = i;
    word.position.x() = float(i);
    codebook.words.push_back(word);
    values.insert(values.end(), shot_size, float(i));
  }
  codebook.descriptors = QuantizedDescriptors(DescriptorMatrix(std::move(values), shot_size));
  for (std::uint32_t object = 0; object < 3; ++object) {
    RegisteredModel model;
    model.object = object;
    model.frame = codebook.objects[object] + "#model";
    model.surface.points = model.surface.normals = {Eigen::Vector3f::UnitX()};
    model.surface.box.extend(Eigen::Vector3f::UnitX());
    codebook.models.push_back(model);
  }
  codebook.checksum.set(5);
  return codebook;
}

TEST(WithoutObject, KeepsAllOfTheOthers) {
  const auto rest = withoutObject(toys(), "frog");
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->name, "toys");
  EXPECT_THAT(rest->objects, ElementsAre("mario", "duck"));
  ASSERT_EQ(rest->views.size(), 4u);
  ASSERT_EQ(rest->words.size(), 4u);
  ASSERT_EQ(rest->descriptors.rows(), 4u);
  const std::uint32_t kept[] = {0, 2, 3, 5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rest->words[i].position.x(), float(kept[i]));
    EXPECT_FLOAT_EQ(rest->descriptors.values().row(i)[shot_size - 1], float(kept[i]));
    EXPECT_EQ(rest->views[rest->words[i].view].source, std::to_string(kept[i]));
    EXPECT_EQ(rest->objectOf(rest->words[i]), kept[i] % 3 == 0 ? "mario" : "duck");
  }
  ASSERT_EQ(rest->models.size(), 2u);
  for (const RegisteredModel& model : rest->models) EXPECT_EQ(model.frame, rest->objects[model.object] + "#model");
  EXPECT_EQ(codebookFault(*rest), "");
  EXPECT_FALSE(rest->checksum.get());
}

TEST(WithoutObject, LeavesNothingOfTheLastOne) {
  EXPECT_FALSE(withoutObject(*withoutObject(*withoutObject(toys(), "frog"), "mario"), "duck"));
}

TEST(WithoutObject, NamesTheNearestObject) {
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [] { withoutObject(toys(), "marios"); }),
              AllOf(HasSubstr("'marios'"), HasSubstr("did you mean 'mario'")));
}

}  // namespace
}  // namespace sks
