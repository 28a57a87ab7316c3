// SPDX-License-Identifier: BSD-3-Clause
// Trains a codebook from a mesh, as a virtual camera sees it from all sides, and prints what the codebook holds.
// Build: cmake -S examples -B build/examples && cmake --build build/examples; run: train_mesh mug mug.ply mug.sks
#include <cstdlib>
#include <iostream>
#include <memory>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/simulation/mesh.hpp>
#include <sks_detector/simulation/training_views.hpp>
#include <sks_detector/trainer.hpp>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: train_mesh NAME MESH CODEBOOK\n";
    return 2;
  }
  const std::string name = argv[1], mesh_file = argv[2], codebook_file = argv[3];
  try {
    const sks::LoadedMesh loaded = sks::loadMesh(mesh_file);
    for (const std::string& warning : loaded.warnings) std::cerr << "warning: " << warning << '\n';
    const auto mesh = std::make_shared<const sks::Mesh>(loaded.mesh);

    const auto samples = sks::meshSamples(name, mesh_file, mesh, sks::MeshTraining());
    const sks::Codebook codebook = sks::train(samples, sks::Settings(), name);
    sks::writeCodebook(codebook_file, codebook);

    std::cout << codebook_file << ": " << codebook.objects.size() << " object, " << codebook.views.size() << " views, "
              << codebook.words.size() << " codewords of " << codebook.descriptorName() << '\n';
  } catch (const sks::Error& error) {
    std::cerr << "train_mesh: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
