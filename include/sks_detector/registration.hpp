// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/stages.hpp>
#include <sks_detector/symmetry.hpp>
#include <sks_detector/trainer.hpp>

namespace sks {

/// How exactly the relative poses of registered views close loops of three.
struct LoopErrors {
  std::size_t loops = 0;
  double median_shift = 0, largest_shift = 0;  ///< [m], at the middle of what a view shows
  double median_angle = 0, largest_angle = 0;  ///< [rad]
};

/// A captured view and its place in the model of its object.
struct RegisteredView {
  std::size_t sample = 0;                            ///< index into the samples
  std::string source;                                ///< of the sample
  std::optional<Eigen::Isometry3d> T_model_view;     ///< none: it stays a view of its own
  std::string reason;                                ///< why it could not be tied to the others, in words; else empty
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< of a tied view: where its camera was, model frame [m]
};

/// An object whose captured views were registered to each other.
struct RegisteredObject {
  std::string object;  ///< name
  std::string frame;   ///< name of its model frame: TrainingView::frame of the tied views
  std::vector<RegisteredView> views;
  bool on_plane = false;  ///< z of the model frame is along the normal of the supporting plane
  LoopErrors loops;
  FusedModel model;                  ///< empty if no views were tied
  std::optional<Symmetry> symmetry;  ///< of the model, about an axis through the centre of its box; none: not known

  std::size_t tied() const;
};

struct ViewRegistration {
  /// For train(): tied views share frame and box of their object. After the last view of an object come views of its
  /// model from directions between them: it is found by them, too, where no picture was taken from.
  std::vector<TrainingSample> samples;
  std::vector<RegisteredObject> objects;  ///< with at least two captured views, in order of their first sample
};

/// Registers the captured views of each object (kind: view, neither rendered nor with a frame of their own) into one
/// model frame. Nothing is guessed: views whose pose at least two others do not confirm, in all six directions, stay
/// views of their own, each with the reason, and so do those that stood on known planes and fit as well when they are
/// turned. Views of a body of revolution, in shape and colour, are tied by its axis: no turn is wrong. Which objects:
/// `training.register_views`.
///
/// The frame: where the supporting planes are known (TrainingSample::plane), z is their normal and x points to where
/// the first view was taken from; else the axes are those of the first view's camera. That is the first one of those
/// that could be tied when there were only the samples up to them, so the axes stay when samples are added at the end;
/// if it is no longer tied, a view that was tied together with it hands the axes over, where there is one. The origin
/// is that of `training.origin`. Deterministic, for any number of threads.
/// @throws what train() throws; Error(cancelled)
ViewRegistration registerViews(const std::vector<TrainingSample>& samples, const Settings& settings,
                               const Progress& progress = {}, const Stages& stages = {});

/// Registers the captured views of one object as they come: each is compared with those before it only once. Not
/// thread-safe.
class ObjectRegistrar {
public:
  /// @throws Error(bad_usage) for invalid settings
  ObjectRegistrar(std::string object, const Settings& settings, const Stages& stages = {});
  ~ObjectRegistrar();
  ObjectRegistrar(ObjectRegistrar&&) noexcept;
  ObjectRegistrar& operator=(ObjectRegistrar&&) noexcept;

  /// @throws Error(bad_data) naming the view if its cloud is unusable; it is then not added
  void add(const TrainingSample& sample);
  /// Forgets the views from this one on.
  void resize(std::size_t views);
  /// Of the views, in their order.
  const std::vector<std::string>& sources() const;

  /// An earlier view that was taken from the same direction, or shows a part of the object that looks the same; none if
  /// there is no such view.
  std::optional<std::size_t> sameAs(std::size_t view) const;

  /// Views are numbered as they were added (RegisteredView::sample).
  RegisteredObject result() const;

private:
  struct Views;
  std::unique_ptr<Views> views_;
};

/// What is to be said of views that could not be tied: one text for each object that has some.
std::vector<std::string> registrationWarnings(const std::vector<RegisteredObject>& objects);

/// A codebook with the models of its objects, thinned, and how these came about, where `training.register_views` is
/// set.
struct RegisteredTraining {
  Codebook codebook;
  std::vector<RegisteredObject> objects;
};

/// train() after registerViews(), if the settings ask for it. @throws what they throw
RegisteredTraining trainRegistered(const std::vector<TrainingSample>& samples, const Settings& settings,
                                   const std::string& name, const Progress& progress = {}, const Stages& stages = {});

}  // namespace sks
