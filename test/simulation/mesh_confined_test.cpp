// SPDX-License-Identifier: BSD-3-Clause
// What a mesh names lies in its folder of confinement, and nothing that is read can block.
#include <filesystem>

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ConfinedMesh : public test::MeshFileTest {
protected:
  ConfinedMesh() {
    fs::create_directories(inside("meshes"));
    fs::create_directories(folder_.path("outside"));
    write("outside/t.png", encodePng(test::boxAtlas()));
    write("outside/m.mtl", "newmtl m\nmap_Kd t.png\n");
  }
  std::string inside(const std::string& name) const { return folder_.path("inside/" + name); }
  LoadedMesh loadInside(const std::string& head) const {
    return loadMesh(write("inside/meshes/a.obj", test::boxObj(head)), 0, folder_.path("inside"));
  }
  void expectRefused(const LoadedMesh& loaded, const std::string& name) const {
    test::expectPlainBox(loaded.mesh);
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_THAT(loaded.warnings[0], HasSubstr(name));
  }
};

TEST_F(ConfinedMesh, WhatLiesInsideIsRead) {
  fs::create_directories(inside("pictures"));
  write("inside/pictures/t.png", encodePng(test::boxAtlas()));
  write("inside/m.mtl", "newmtl m\nmap_Kd pictures/t.png\n");  // as seen from the materials
  test::expectColoredBox(loadInside("mtllib ../m.mtl\nusemtl m\n").mesh);
  write("inside/m.mtl", "newmtl m\nmap_Kd ../pictures/t.png\n");  // as seen from the mesh
  test::expectColoredBox(loadInside("mtllib ../m.mtl\nusemtl m\n").mesh);
}

TEST_F(ConfinedMesh, NamesThatLeadOutAreRefused) {
  expectRefused(loadInside("mtllib ../../outside/m.mtl\nusemtl m\n"), "outside of the allowed folder");
  expectRefused(loadInside("mtllib " + folder_.path("outside/m.mtl") + "\nusemtl m\n"),
                "outside of the allowed folder");
  for (const std::string& name : {folder_.path("outside/t.png"), std::string("../../outside/t.png")}) {
    write("inside/meshes/m.mtl", "newmtl m\nmap_Kd " + name + "\n");
    expectRefused(loadInside("mtllib m.mtl\nusemtl m\n"), "its texture '" + name + "'");
  }
  fs::create_symlink(folder_.path("outside/t.png"), inside("meshes/link.png"));
  write("inside/meshes/m.mtl", "newmtl m\nmap_Kd link.png\n");
  expectRefused(loadInside("mtllib m.mtl\nusemtl m\n"), "its texture 'link.png'");
}

TEST_F(ConfinedMesh, WithoutAFolderAllNamesAreFollowed) {
  const std::string head = "mtllib ../../outside/m.mtl\nusemtl m\n";
  test::expectColoredBox(loadMesh(write("inside/meshes/a.obj", test::boxObj(head))).mesh);
}

TEST_F(ConfinedMesh, PipesAndDevicesAreRefusedAtOnce) {
  ASSERT_EQ(::mkfifo(inside("meshes/pipe").c_str(), 0600), 0);
  expectRefused(loadInside("mtllib pipe\nusemtl m\n"), "it is no regular file but a pipe or device");
  write("inside/meshes/m.mtl", "newmtl m\nmap_Kd pipe\n");
  expectRefused(loadInside("mtllib m.mtl\nusemtl m\n"), "its texture 'pipe'");
  for (const char* ending : {"obj", "ply", "stl", "dae"}) {
    const std::string name = folder_.path(std::string("mesh.") + ending);
    ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0);
    EXPECT_THAT(refusal(name), HasSubstr("it is no regular file but a pipe or device"));
  }
  write("inside/meshes/m.mtl", "newmtl m\nmap_Kd /dev/zero\n");
  EXPECT_FALSE(loadMesh(inside("meshes/a.obj")).mesh.hasColor());
}

}  // namespace
}  // namespace sks
