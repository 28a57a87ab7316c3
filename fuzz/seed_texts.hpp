// SPDX-License-Identifier: BSD-3-Clause
// Small files of the formats that are read but not written here.
#pragma once

#include <string>

namespace sks::fuzz {

const std::string pcd_fields =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\n"
    "COUNT 1 1 1 1\n";

const std::string ascii_pcd =
    pcd_fields + "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n0.1 -2 1e0 255\nnan nan nan 0\n";

/// One point: a run of 16 bytes as they are.
inline std::string compressedPcd() {
  const std::string lengths("\x11\0\0\0\x10\0\0\0", 8), packed = '\x0f' + std::string(16, '\x3f');
  return pcd_fields + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary_compressed\n" + lengths + packed;
}

const std::string ascii_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 1 1 2 3\n1 0 1 1 2 3\n0 1 1 1 2 3\n3 0 1 2\n";

inline std::string binaryPly() {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\nproperty float y\n"
         "property float z\nelement camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n"
         "element face 1\nproperty list uchar ushort vertex_indices\nend_header\n" +
         std::string(32, '\x3f') + std::string(12, '\0') + std::string("\x02\x01\0\0\0", 5);
}

const std::string obj = "mtllib m.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n";

const std::string stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid a\n";

const std::string training_set =
    "name: things\nunits: mm\ntraining:\n"
    "  - {object: mug, cloud: 'builtin:mug', kind: mesh, symmetry: {axis: [0, 0, 1], order: inf}}\n"
    "  - object: box\n    cloud: builtin:box\n    kind: mesh\n";

const std::string scene_set =
    "name: scenes\nunits: m\nmax_distance: 0.05\nscenes:\n  - name: one\n    cloud: builtin:scene\n    objects:\n"
    "      - object: mug\n        position: [0.1, 0, 0.8]\n        reference: builtin:mug\n"
    "        pose: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0.8, 0, 0, 0, 1]\n        visibility: 0.7\n"
    "    ignore: [frog]\ntests:\n  - {object: chair, cloud: 'builtin:chair'}\n";

}  // namespace sks::fuzz
