// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/codebook_file.hpp>

#include <cmath>
#include <cstring>
#include <future>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include <sks_detector/settings_file.hpp>

#include "codebook_generated.h"
#include "core/surface/color_space.hpp"
#include "error_of.hpp"
#include "io/codebook_layout.hpp"
#include "io/crc32c.hpp"
#include "io/file.hpp"
#include "old_codebook.hpp"
#include "temporary_folder.hpp"

namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using sks::test::sealed;
using sks::test::writeFile;

sks::Codebook makeCodebook(sks::DescriptorType type = sks::DescriptorType::shot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(0, 1);
  const auto vector = [&] { return Eigen::Vector3f(number(random), number(random), number(random)); };
  sks::Codebook codebook;
  codebook.name = "toys";
  codebook.descriptor_type = codebook.settings.descriptor.type = type;
  codebook.settings.keypoints.grid_size = 0.03;
  codebook.objects = {"mario", "frog"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    sks::TrainingView view;
    view.object = i % 2;
    view.source = "view" + std::to_string(i) + ".pcd";
    view.kind = i == 2 ? sks::ViewKind::model : sks::ViewKind::view;
    view.sensor_origin = vector();
    view.box_min = -vector();
    view.box_max = vector();
    for (std::uint32_t k = 0; k < i; ++k) {
      view.surface_points.push_back(vector());
      view.surface_normals.push_back(vector().normalized());
      if (i == 2) view.surface_colors.push_back(vector());
    }
    codebook.views.push_back(view);
  }
  sks::RegisteredModel model;
  model.object = 1;
  model.frame = "frog#model";
  model.surface.box = {-vector(), vector()};
  for (int i = 0; i < 3; ++i) {
    model.surface.points.push_back(vector());
    model.surface.normals.push_back(vector().normalized());
    model.surface.colors.push_back({std::uint8_t(i), 100, 255});
  }
  model.symmetry = sks::Symmetry{Eigen::Vector3d::UnitY(), 2};
  codebook.models = {model};
  std::vector<float> values;
  for (std::uint32_t i = 0; i < 2; ++i) {
    sks::Codeword word;
    word.view = i;
    word.position = vector();
    for (int row = 0; row < 3; ++row) word.frame.row(row) = vector();
    codebook.words.push_back(word);
    for (std::size_t bin = 0; bin < sks::descriptorSize(type); ++bin) values.push_back(number(random));
  }
  codebook.descriptors = sks::QuantizedDescriptors(sks::DescriptorMatrix(std::move(values), sks::descriptorSize(type)));
  std::vector<float> background(3 * sks::descriptorSize(type));
  for (float& bin : background) bin = number(random);
  codebook.background =
      sks::QuantizedDescriptors(sks::DescriptorMatrix(std::move(background), sks::descriptorSize(type)));
  return codebook;
}

class CodebookFile : public ::testing::Test {
protected:
  /// The reason of the error that reading a file of this content gives.
  std::string readError(const std::string& content) const {
    writeFile(path_, content);
    return readError();
  }
  std::string readError() const {
    const std::string message = errorOf(ErrorCode::bad_file, [&] { sks::readCodebook(path_); });
    const std::string start = "cannot read codebook '" + path_ + "': ";
    EXPECT_EQ(message.rfind(start, 0), 0u) << message;
    return message.substr(std::min(start.size(), message.size()));
  }

  /// The bytes of a whole codebook.
  std::string content() const {
    sks::writeCodebook(path_, makeCodebook());
    return sks::readTextFile(path_);
  }

  const sks::test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("toys.sks");
};

void expectEqual(const sks::QuantizedDescriptors& a, const sks::QuantizedDescriptors& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  for (std::size_t row = 0; row < a.rows(); ++row) {
    EXPECT_EQ(a.scale(row), b.scale(row));
    EXPECT_EQ(std::memcmp(a.levels(row), b.levels(row), a.cols()), 0);
  }
}

std::string withHeader(const std::string& content, void (*change)(sks::CodebookHeader&)) {
  sks::CodebookHeader header;
  std::memcpy(&header, content.data(), sizeof(header));
  change(header);
  return sealed(
      std::string(content).replace(0, sizeof(header), reinterpret_cast<const char*>(&header), sizeof(header)));
}

/// A file of this metadata, without descriptors.
std::string ofMetadata(const flatbuffers::FlatBufferBuilder& builder, std::uint32_t version) {
  sks::CodebookHeader header;
  header.version = version;
  header.metadata_offset = sizeof(header);
  header.metadata_size = builder.GetSize();
  std::string content(sizeof(header), '\0');
  content.append(reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize());
  content.resize((content.size() + 63) / 64 * 64);
  header.descriptors_offset = header.file_size = content.size();
  content.replace(0, sizeof(header), reinterpret_cast<const char*>(&header), sizeof(header));
  return sealed(content);
}

}  // namespace

TEST(Crc32c, KnownValues) {
  EXPECT_EQ(sks::crc32c("123456789", 9), 0xe3069283u);
  EXPECT_EQ(sks::crc32c(std::string(32, '\0').data(), 32), 0x8a9136aau);  // RFC 3720, B.4
  EXPECT_EQ(sks::crc32c(std::string(32, '\xff').data(), 32), 0x62a8ab43u);
  EXPECT_EQ(sks::crc32c("", 0), 0u);
  EXPECT_EQ(sks::crc32c("6789", 4, sks::crc32c("12345", 5)), 0xe3069283u);
}

TEST_F(CodebookFile, ReleasedIsTheSameFileWithoutTheSurfacesInMemory) {
  sks::Codebook codebook = makeCodebook();
  const std::uint32_t checksum = sks::writeCodebook(path_, codebook);
  const std::string whole = sks::readTextFile(path_);
  codebook = makeCodebook();
  EXPECT_EQ(sks::writeAndRelease(path_, codebook), checksum);
  EXPECT_EQ(sks::readTextFile(path_), whole);
  EXPECT_EQ(codebook.checksum.get(), checksum);
  EXPECT_EQ(codebook.words.size(), makeCodebook().words.size());
  for (const sks::TrainingView& view : codebook.views) {
    EXPECT_EQ(view.surface_points.capacity() + view.surface_normals.capacity() + view.surface_colors.capacity(), 0u);
    EXPECT_FALSE(view.source.empty());
  }
}

TEST_F(CodebookFile, RoundTripKeepsEverything) {
  for (const auto type : {sks::DescriptorType::shot, sks::DescriptorType::cshot}) {
    const sks::Codebook codebook = makeCodebook(type);
    const std::uint32_t checksum = sks::writeCodebook(path_, codebook);
    const auto back = sks::readCodebook(path_);
    EXPECT_EQ(back->checksum.get(), checksum);
    EXPECT_EQ(back->name, codebook.name);
    EXPECT_EQ(back->descriptor_type, type);
    EXPECT_EQ(sks::settingsToYaml(back->settings), sks::settingsToYaml(codebook.settings));
    EXPECT_EQ(back->objects, codebook.objects);
    ASSERT_EQ(back->views.size(), codebook.views.size());
    for (std::size_t i = 0; i < codebook.views.size(); ++i) {
      EXPECT_EQ(back->views[i].object, codebook.views[i].object);
      EXPECT_EQ(back->views[i].source, codebook.views[i].source);
      EXPECT_EQ(back->views[i].kind, codebook.views[i].kind);
      EXPECT_EQ(back->views[i].sensor_origin, codebook.views[i].sensor_origin);
      EXPECT_EQ(back->views[i].box_min, codebook.views[i].box_min);
      EXPECT_EQ(back->views[i].box_max, codebook.views[i].box_max);
      EXPECT_EQ(back->views[i].surface_points, codebook.views[i].surface_points);
      EXPECT_EQ(back->views[i].surface_normals, codebook.views[i].surface_normals);
      EXPECT_EQ(back->views[i].surface_colors, codebook.views[i].surface_colors);
    }
    ASSERT_EQ(back->words.size(), codebook.words.size());
    for (std::size_t i = 0; i < codebook.words.size(); ++i) {
      EXPECT_EQ(back->words[i].view, codebook.words[i].view);
      EXPECT_EQ(back->words[i].position, codebook.words[i].position);
      EXPECT_EQ(back->words[i].frame, codebook.words[i].frame);
    }
    ASSERT_EQ(back->models.size(), 1u);
    const sks::RegisteredModel &model = codebook.models[0], &model_back = back->models[0];
    EXPECT_EQ(model_back.object, model.object);
    EXPECT_EQ(model_back.frame, model.frame);
    EXPECT_EQ(model_back.surface.box.min(), model.surface.box.min());
    EXPECT_EQ(model_back.surface.box.max(), model.surface.box.max());
    EXPECT_EQ(model_back.surface.points, model.surface.points);
    EXPECT_EQ(model_back.surface.normals, model.surface.normals);
    ASSERT_EQ(model_back.surface.colors.size(), 3u);
    EXPECT_EQ(model_back.surface.colors[2].r, 2);
    EXPECT_EQ(model_back.surface.colors[2].b, 255);
    ASSERT_TRUE(model_back.symmetry);
    EXPECT_EQ(model_back.symmetry->axis, Eigen::Vector3d::UnitY());
    EXPECT_EQ(model_back.symmetry->order, 2);
    expectEqual(back->descriptors, codebook.descriptors);
    expectEqual(back->background, codebook.background);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(back->descriptors.levels(0)) % 64, 0u);
  }
}

TEST_F(CodebookFile, EveryColourIsKeptInThreeBytes) {
  sks::Codebook codebook = makeCodebook();
  sks::TrainingView& view = codebook.views[2];
  constexpr int step = 5;
  for (int r = 0; r < 256; r += step) {
    for (int g = 0; g < 256; g += step) {
      for (int b = 0; b < 256; b += step) {
        const auto lab = sks::toScaledLab({std::uint8_t(r), std::uint8_t(g), std::uint8_t(b)});
        view.surface_colors.emplace_back(lab[0], lab[1], lab[2]);
      }
    }
  }
  view.surface_colors.erase(view.surface_colors.begin(), view.surface_colors.begin() + 2);  // which are no sRGB
  view.surface_points.assign(view.surface_colors.size(), Eigen::Vector3f::Ones());
  view.surface_normals.assign(view.surface_colors.size(), Eigen::Vector3f::UnitX());
  sks::writeCodebook(path_, codebook);
  EXPECT_EQ(sks::readCodebook(path_)->views[2].surface_colors, view.surface_colors);
  EXPECT_LT(sks::readTextFile(path_).size(), view.surface_colors.size() * (2 * 12 + 3) + 5000);

  view.surface_colors[7].x() += 1e-6f;  // one that no sRGB gives: all stay as they are
  sks::writeCodebook(path_, codebook);
  EXPECT_EQ(sks::readCodebook(path_)->views[2].surface_colors, view.surface_colors);
  EXPECT_GT(sks::readTextFile(path_).size(), view.surface_colors.size() * 3 * 12);
}

TEST_F(CodebookFile, TheSecondVersionIsRead) {
  sks::Codebook old = makeCodebook();
  old.background = {};
  sks::writeCodebook(path_, old);
  const std::string whole = sks::readTextFile(path_);
  writeFile(path_, withHeader(whole, [](sks::CodebookHeader& header) { header.version = 2; }));
  const auto back = sks::readCodebook(path_);
  EXPECT_EQ(back->views[2].surface_colors, old.views[2].surface_colors);
  expectEqual(back->descriptors, old.descriptors);
  EXPECT_EQ(back->background.rows(), 0u);
}

TEST_F(CodebookFile, ColoursThatStandThereTwiceAreRefused) {
  namespace format = sks::format;
  flatbuffers::FlatBufferBuilder builder;
  const format::Vec3 zero(0, 0, 0);
  const auto vectors = builder.CreateVectorOfStructs(std::vector<format::Vec3>(2));
  const auto levels = builder.CreateVectorOfStructs(std::vector<format::Color>(2));
  const auto view = format::CreateView(builder, 0, builder.CreateString("a.pcd"), format::ViewKind_view, &zero, &zero,
                                       &zero, vectors, vectors, 0, vectors, nullptr, levels);
  const auto views = builder.CreateVector(std::vector<flatbuffers::Offset<format::View>>{view});
  const auto objects = builder.CreateVectorOfStrings({"mug"});
  const auto words = builder.CreateVectorOfStructs(std::vector<format::Word>());
  format::FinishCodebookBuffer(
      builder, format::CreateCodebook(builder, builder.CreateString("toys"), builder.CreateString("shot"), 352,
                                      builder.CreateString(std::string(100, ' ')), objects, views, words));
  EXPECT_EQ(readError(ofMetadata(builder, 3)), "its training cloud 'a.pcd' has colours twice; train it again");
}

TEST_F(CodebookFile, WithoutModelsNothingIsStoredOfThem) {
  sks::Codebook codebook = makeCodebook();
  codebook.models[0].symmetry.reset();
  codebook.models[0].surface.colors.clear();
  sks::writeCodebook(path_, codebook);
  EXPECT_FALSE(sks::readCodebook(path_)->models[0].symmetry);
  EXPECT_TRUE(sks::readCodebook(path_)->models[0].surface.colors.empty());
  codebook.models.clear();
  sks::writeCodebook(path_, codebook);
  EXPECT_TRUE(sks::readCodebook(path_)->models.empty());
}

TEST_F(CodebookFile, ModelsThatAreNoneAreNamed) {
  using Change = void (*)(sks::RegisteredModel&);
  const std::pair<Change, const char*> faults[] = {
      {[](sks::RegisteredModel& m) { m.object = 2; }, "belongs to an object that is not there"},
      {[](sks::RegisteredModel& m) { m.surface.normals.pop_back(); }, "has not one normal for each of its points"},
      {[](sks::RegisteredModel& m) { m.surface.colors.pop_back(); }, "has not one colour for each of its points"},
      {[](sks::RegisteredModel& m) { m.surface.points[1].x() = std::nanf(""); }, "does not lie within 1000 km"},
      {[](sks::RegisteredModel& m) { m.surface.normals[1] *= 2; }, "has a normal that is no unit vector"},
      {[](sks::RegisteredModel& m) { m.surface.box.setEmpty(); }, "has a box that is not within 1000 km"},
      {[](sks::RegisteredModel& m) { m.symmetry->order = -1; }, "has a symmetry that is none"},
      {[](sks::RegisteredModel& m) { m.symmetry->axis *= 2; }, "has a symmetry that is none"},
  };
  for (const auto& [change, fault] : faults) {
    sks::Codebook codebook = makeCodebook();
    change(codebook.models[0]);
    EXPECT_EQ(sks::codebookFault(codebook), std::string("its model 'frog#model' ") + fault);
  }
}

TEST_F(CodebookFile, DescriptorsOutliveTheCodebook) {
  sks::writeCodebook(path_, makeCodebook());
  auto codebook = sks::readCodebook(path_);
  const sks::QuantizedDescriptors descriptors = codebook->descriptors;
  const float last = makeCodebook().descriptors.values().row(1)[351];
  codebook.reset();
  ::unlink(path_.c_str());
  EXPECT_EQ(descriptors.values().row(1)[351], last);
}

TEST_F(CodebookFile, SameCodebookSameBytes) {
  const std::string first = content();
  EXPECT_EQ(content(), first);
  EXPECT_EQ(folder_.fileCount(), 1u);
}

TEST_F(CodebookFile, OfTwoThreadsThatWriteANewOneAloneDoes) {
  for (int round = 0; round < 30; ++round) {
    std::vector<std::future<bool>> writers;
    for (const char* name : {"one", "other"}) {
      writers.push_back(std::async(std::launch::async, [&, name] {
        sks::Codebook codebook = makeCodebook();
        codebook.name = name;
        return sks::writeNewCodebook(path_, codebook);
      }));
    }
    const bool first = writers[0].get(), second = writers[1].get();
    EXPECT_NE(first, second);
    EXPECT_EQ(sks::readCodebook(path_)->name, first ? "one" : "other");
    EXPECT_EQ(folder_.fileCount(), 1u);
    ::unlink(path_.c_str());
  }
}

TEST_F(CodebookFile, ChecksumIsKnownBeforeWriting) {
  const sks::Codebook codebook = makeCodebook();
  EXPECT_EQ(sks::codebookChecksum(codebook), sks::writeCodebook(path_, codebook));
  EXPECT_EQ(sks::codebookChecksum(*sks::readCodebook(path_)), sks::codebookChecksum(codebook));
}

TEST_F(CodebookFile, ChecksumIsRememberedAndACopyMayDiffer) {
  const sks::Codebook codebook = makeCodebook();
  EXPECT_FALSE(codebook.checksum.get());
  const std::uint32_t checksum = sks::codebookChecksum(codebook);
  EXPECT_EQ(codebook.checksum.get(), checksum);
  sks::Codebook copy = codebook;
  EXPECT_FALSE(copy.checksum.get());
  copy.name = "other toys";
  EXPECT_NE(sks::codebookChecksum(copy), checksum);
  const sks::Codebook moved = std::move(copy);
  EXPECT_NE(moved.checksum.get(), checksum);
  EXPECT_TRUE(moved.checksum.get());
}

TEST_F(CodebookFile, ThreadsAreNoPartOfACodebook) {
  const std::string first = content();
  sks::Codebook codebook = makeCodebook();
  codebook.settings.threads = 7;
  sks::writeCodebook(path_, codebook);
  EXPECT_EQ(sks::readTextFile(path_), first);
  EXPECT_EQ(sks::readCodebook(path_)->settings.threads, 0);
}

TEST_F(CodebookFile, MissingEmptyAndForeign) {
  EXPECT_EQ(readError(), "No such file or directory");
  EXPECT_EQ(errorOf(ErrorCode::bad_file, [&] { sks::readCodebook(folder_.path()); }),
            "cannot read codebook '" + folder_.path() + "': it is a folder; give the name of a file");
  EXPECT_EQ(readError(""), "it is empty; train it again");
  EXPECT_EQ(readError("hello"), "it is no codebook");
  EXPECT_EQ(readError("# .PCD v0.7 - Point Cloud Data file format\n" + std::string(1000, 'x')), "it is no codebook");
  EXPECT_EQ(readError(std::string(200, '\0')), "it is no codebook");
}

TEST_F(CodebookFile, EveryTruncationIsNamed) {
  const std::string whole = content();
  for (std::size_t length = 1; length < whole.size(); length += length < 200 ? 1 : 37) {
    EXPECT_EQ(readError(whole.substr(0, length)).rfind("it is truncated: ", 0), 0u) << length;
  }
  EXPECT_EQ(readError(whole.substr(0, whole.size() - 1)), "it is truncated: " + std::to_string(whole.size() - 1) +
                                                              " of " + std::to_string(whole.size()) +
                                                              " bytes; copy it again");
  EXPECT_EQ(readError(whole + "x"), "it is damaged (its checksum does not match); copy or train it again");
}

TEST_F(CodebookFile, EveryFlippedByteIsRefused) {
  const std::string whole = content();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = char(damaged[at] ^ (1 << (at % 8)));
    const std::string expected = at < 8    ? "it is no codebook"
                                 : at < 64 ? "its header is damaged; copy or train it again"
                                           : "it is damaged (its checksum does not match); copy or train it again";
    ASSERT_EQ(readError(damaged), expected) << "byte " << at;
  }
}

TEST_F(CodebookFile, NewerVersionAsksForAnUpdate) {
  EXPECT_EQ(readError(withHeader(content(), [](sks::CodebookHeader& header) { header.version = 4; })),
            "it was written by a newer version (file format 4, this build reads up to 3): update sks_detector");
}

TEST_F(CodebookFile, FloatsOfTheFirstVersionAreRounded) {
  const sks::Codebook codebook = makeCodebook();
  const sks::DescriptorMatrix values = codebook.descriptors.values();
  writeFile(path_, sks::test::ofFirstVersion(content(), values));
  const auto back = sks::readCodebook(path_);
  EXPECT_EQ(back->words.size(), 2u);
  EXPECT_EQ(back->views.size(), 3u);
  ASSERT_EQ(back->descriptors.rows(), 2u);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(std::memcmp(back->descriptors.levels(row), codebook.descriptors.levels(row), values.cols()), 0);
  }
  EXPECT_FLOAT_EQ(back->descriptors.scale(1), codebook.descriptors.scale(1));

  const std::vector<float> three(3 * values.cols(), 0.1f), negative(2 * values.cols(), -0.1f);
  writeFile(path_, sks::test::ofFirstVersion(content(), sks::DescriptorMatrix(three, values.cols())));
  EXPECT_EQ(readError(), "its 2 codewords have 3 descriptors of 352 bins; train it again");
  writeFile(path_, sks::test::ofFirstVersion(content(), sks::DescriptorMatrix({1, 2, 3}, 3)));
  EXPECT_EQ(readError(), "its descriptors have no whole rows; train it again");
  writeFile(path_, sks::test::ofFirstVersion(content(), sks::DescriptorMatrix(negative, values.cols())));
  EXPECT_EQ(readError(), "descriptor 0 is no histogram: bin 0 is -0.100000; train it again");
}

TEST_F(CodebookFile, SectionsMustLieInsideTheFile) {
  const std::string whole = content();
  using Change = void (*)(sks::CodebookHeader&);
  const Change changes[] = {
      [](sks::CodebookHeader& header) { header.version = 0; },
      [](sks::CodebookHeader& header) { header.header_size = 128; },
      [](sks::CodebookHeader& header) { header.metadata_offset = 0; },
      [](sks::CodebookHeader& header) { header.metadata_offset = 65; },
      [](sks::CodebookHeader& header) { header.metadata_size = header.file_size; },
      [](sks::CodebookHeader& header) { header.metadata_size = std::numeric_limits<std::uint64_t>::max() - 32; },
      [](sks::CodebookHeader& header) { header.descriptors_offset = std::uint64_t{1} << 63; },
      [](sks::CodebookHeader& header) { header.descriptors_size += 64; },
  };
  for (const Change change : changes) {
    EXPECT_EQ(readError(withHeader(whole, change)),
              "it is damaged (its checksum does not match); copy or train it again");
  }
  EXPECT_EQ(readError(withHeader(whole, [](sks::CodebookHeader& header) { header.descriptors_size -= 4; })),
            "its 2 codewords and 3 descriptors of the background have not one descriptor each; train it again");
  EXPECT_EQ(readError(withHeader(whole, [](sks::CodebookHeader& header) { header.descriptors_size = 0; })),
            "its 2 codewords and 3 descriptors of the background have not one descriptor each; train it again");
  EXPECT_EQ(readError(withHeader(whole, [](sks::CodebookHeader& header) { header.metadata_size = 0; })),
            "its metadata is damaged; train it again");
}

/// Damage that a checksum cannot show, because it was made before: reading ends with a codebook or an Error.
TEST_F(CodebookFile, MetadataIsVerifiedBehindTheChecksum) {
  const std::string whole = content();
  const std::size_t metadata_end = whole.size() - 64 - 5 * 352;
  std::size_t refused = 0;
  for (std::size_t at = 64; at < metadata_end; ++at) {
    std::string damaged = whole;
    damaged[at] = char(damaged[at] ^ 0xff);
    writeFile(path_, sealed(damaged));
    try {
      const auto codebook = sks::readCodebook(path_);
      EXPECT_EQ(sks::codebookFault(*codebook), "");
    } catch (const sks::Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_file) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
}

/// Eight thousand objects of one name of 8000 bytes: 64 MB from a file of 40 kB, were they copied.
TEST_F(CodebookFile, SharedTextIsNotMultiplied) {
  namespace format = sks::format;
  flatbuffers::FlatBufferBuilder builder;
  const auto text = builder.CreateString(std::string(8000, 'x'));
  const auto objects = builder.CreateVector(std::vector<flatbuffers::Offset<flatbuffers::String>>(8000, text));
  const auto views = builder.CreateVector(std::vector<flatbuffers::Offset<format::View>>());
  const auto words = builder.CreateVectorOfStructs(std::vector<format::Word>());
  format::FinishCodebookBuffer(builder, format::CreateCodebook(builder, text, builder.CreateString("shot"), 352,
                                                               builder.CreateString(""), objects, views, words));
  const std::string content = ofMetadata(builder, 1);
  EXPECT_LT(content.size(), 50000u);
  EXPECT_EQ(readError(content), "its metadata is damaged; train it again");
}

TEST_F(CodebookFile, UnknownSettingsAreNamed) {
  std::string whole = content();
  whole.replace(whole.find("discard"), 7, "discord");
  const std::string message = readError(sealed(whole));
  EXPECT_EQ(message.rfind("it was trained with settings that this version does not know: settings:", 0), 0u) << message;
  EXPECT_NE(message.find("unknown setting 'keypoints.discord': did you mean 'keypoints.discard'?; train it again"),
            std::string::npos)
      << message;
}

TEST_F(CodebookFile, OldNamesOfSettingsAreUnderstood) {
  sks::Codebook codebook = makeCodebook();
  codebook.settings.matching.ambiguity = 1.5;
  codebook.settings.keypoints.skip_planes = false;
  codebook.settings.verification.candidates = 30;
  sks::writeCodebook(path_, codebook);
  const sks::Settings stored = sks::readCodebook(path_)->settings;
  const std::string whole = sks::readTextFile(path_);

  writeFile(path_, sks::test::withOldSettings(whole, stored, 30));
  EXPECT_EQ(sks::readTextFile(path_).find("matching:"), std::string::npos);
  EXPECT_EQ(sks::settingsToYaml(sks::readCodebook(path_)->settings), sks::settingsToYaml(stored));

  writeFile(path_, sks::test::withOldSettings(whole, stored, 0));
  const sks::Settings published = sks::readCodebook(path_)->settings;
  EXPECT_EQ(published.detection.hypotheses, sks::Hypotheses::hough);
  EXPECT_EQ(published.verification.candidates, sks::Settings().verification.candidates);
  EXPECT_EQ(published.matching.ambiguity, 1.5);
  EXPECT_FALSE(published.keypoints.skip_planes);
}

TEST_F(CodebookFile, UnknownDescriptorsAreNamed) {
  std::string whole = content();
  whole.replace(whole.rfind("shot"), 4, "fpfh");  // the one in the settings lies before it
  EXPECT_EQ(readError(sealed(whole)),
            "it holds descriptors of the unknown type 'fpfh' with 352 bins: update sks_detector");
}

// Sums and squares of what is finite but huge are not: votes would lie nowhere.
TEST_F(CodebookFile, NumbersNearOverflowAreRefused) {
  const auto fault = [&](const auto& change) {
    sks::Codebook codebook = makeCodebook();
    change(codebook);
    return sks::codebookFault(codebook);
  };
  const float huge = 1e30f;
  EXPECT_EQ(fault([&](auto& codebook) { codebook.words[1].position.x() = huge; }),
            "its codeword 1 does not lie within 1000 km");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.words[1].frame(2, 0) = -huge; }),
            "its codeword 1 has a reference frame whose axes are no unit vectors");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.views[0].sensor_origin.z() = -huge; }),
            "its training cloud 'view0.pcd' has a sensor origin that is not within 1000 km");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.views[0].box_max.z() = huge; }),
            "its training cloud 'view0.pcd' has a box that is not within 1000 km");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.views[2].surface_points[0].y() = -huge; }),
            "its training cloud 'view2.pcd' has a surface that is not within 1000 km");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.views[2].surface_normals[0].y() = huge; }),
            "its training cloud 'view2.pcd' has a surface normal that is no unit vector");
  EXPECT_EQ(fault([&](auto& codebook) { codebook.views[2].surface_colors[0].y() = huge; }),
            "its training cloud 'view2.pcd' has a surface colour that is none");
}

TEST_F(CodebookFile, OnlySoundCodebooksAreWritten) {
  const auto writeError = [&](const sks::Codebook& codebook) {
    const std::string message = errorOf(ErrorCode::bad_file, [&] { sks::writeCodebook(path_, codebook); });
    return message.substr(std::string("cannot write codebook '" + path_ + "': ").size());
  };
  sks::Codebook codebook = makeCodebook();
  codebook.words[1].view = 3;
  EXPECT_EQ(writeError(codebook), "its codeword 1 belongs to a training cloud that is not there");
  codebook = makeCodebook();
  codebook.words.pop_back();
  EXPECT_EQ(writeError(codebook), "its 1 codewords have 2 descriptors of 352 bins");
  codebook = makeCodebook();
  const float scales[] = {1, std::numeric_limits<float>::infinity()};
  codebook.descriptors = sks::QuantizedDescriptors(codebook.descriptors.levels(0), scales, 2, 352, {});
  EXPECT_EQ(writeError(codebook), "its codeword 1 has a descriptor that is none");
  codebook = makeCodebook();
  codebook.background = sks::QuantizedDescriptors(sks::DescriptorMatrix(std::vector<float>(4, 0.5f), 4));
  EXPECT_EQ(writeError(codebook), "the descriptors of its background have 4 bins, not 352");
  codebook.background = sks::QuantizedDescriptors(codebook.descriptors.levels(0), scales, 2, 352, {});
  EXPECT_EQ(writeError(codebook), "descriptor 1 of its background is none");
  codebook = makeCodebook();
  codebook.words[0].frame(1, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(writeError(codebook), "its codeword 0 has a reference frame whose axes are no unit vectors");
  codebook = makeCodebook();
  codebook.views[2].surface_normals.pop_back();
  EXPECT_EQ(writeError(codebook), "its training cloud 'view2.pcd' has not one normal for each surface point");
  codebook = makeCodebook();
  codebook.views[2].frame = std::string(4097, 'x');
  EXPECT_EQ(writeError(codebook), "its training cloud 'view2.pcd' has a frame with a name of more than 4096 bytes");
  codebook = makeCodebook();
  codebook.views[2].surface_colors.pop_back();
  EXPECT_EQ(writeError(codebook), "its training cloud 'view2.pcd' has not one colour for each surface point");
  codebook = makeCodebook();
  codebook.views[0].object = 2;
  EXPECT_EQ(writeError(codebook), "its training cloud 'view0.pcd' belongs to an object that is not there");
  codebook = makeCodebook();
  codebook.descriptor_type = sks::DescriptorType::automatic;
  EXPECT_EQ(writeError(codebook), "its descriptor type is not decided");
  EXPECT_EQ(folder_.fileCount(), 0u);
}

TEST_F(CodebookFile, FailedWriteKeepsTheOldFile) {
  const std::string before = content();
  sks::Codebook codebook = makeCodebook();
  codebook.words[1].view = 3;
  EXPECT_THROW(sks::writeCodebook(path_, codebook), sks::Error);
  EXPECT_EQ(sks::readTextFile(path_), before);
  EXPECT_EQ(errorOf(ErrorCode::bad_file, [&] { sks::writeCodebook(folder_.path("none/a.sks"), makeCodebook()); }),
            "cannot write '" + folder_.path("none/a.sks") + "': the folder " + folder_.path("none") +
                " does not exist; create it first");
}
