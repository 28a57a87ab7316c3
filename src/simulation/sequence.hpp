// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "simulation/scene.hpp"

namespace sks {

/// What happens in a sequence.
struct SequenceOptions {
  double seconds = 10;  ///< how long it is [s]
  double rate = 30;     ///< pictures in a second [Hz]
  double swing = 20;    ///< by which the camera goes around the table, to either side [deg]
  bool push = true;     ///< one object is pushed over the table by a hand's breadth, from 0.3 to 0.5 of the time
  bool hand = true;     ///< something like an arm passes in front of the objects, from 0.6 to 0.8 of the time
};

/// A picture of a sequence.
struct SequenceFrame {
  SimulatedScene scene;  ///< objects always in the same order
  double stamp = 0;      ///< since the first picture [s]
};

/// A cluttered table before a camera that moves. Same models, options and number, same pictures.
class SimulatedSequence {
public:
  /// @throws Error(bad_usage) naming the value and its range for impossible options
  SimulatedSequence(const std::vector<SceneModel>& models, const SceneOptions& scene, const SequenceOptions& sequence,
                    std::uint64_t number);
  ~SimulatedSequence();
  SimulatedSequence(SimulatedSequence&&) noexcept;
  SimulatedSequence& operator=(SimulatedSequence&&) noexcept;

  std::size_t size() const;  ///< pictures
  /// Index of the pushed object among those of each picture; size of the list: none.
  std::size_t pushed() const;
  SequenceFrame at(std::size_t frame);

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sks
