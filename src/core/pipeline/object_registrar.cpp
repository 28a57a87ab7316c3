// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <sks_detector/registration.hpp>

#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/registration/captured_view.hpp"
#include "core/registration/model_fusion.hpp"
#include "core/registration/view_graph.hpp"
#include "core/registration/view_relation.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

// Of a view that shows nothing new: how far it was taken from the direction of an earlier one [rad], 8 degrees, and how
// much of it the earlier one shows.
constexpr double same_direction = 0.14, same_overlap = 0.8;

/// Moves the origin of the model to where the settings want it.
void moveOrigin(RegisteredObject& object, TiedViews& tied, ModelOrigin wanted) {
  if (object.model.box.isEmpty()) return;
  Eigen::Vector3f origin = object.model.box.center();
  if (wanted == ModelOrigin::first) origin = tied.axes->first_middle.cast<float>();
  if (object.on_plane && wanted != ModelOrigin::center) origin.z() = 0;
  for (auto& pose : tied.T_model_view) {
    if (pose) pose->pretranslate(-origin.cast<double>());
  }
  for (Eigen::Vector3f& p : object.model.points) p -= origin;
  object.model.box.translate(-origin);
}

}  // namespace

struct ObjectRegistrar::Views {
  Views(std::string name, const Settings& wanted, const Stages& stages)
      : object(std::move(name)),
        settings(wanted),
        threads(startableThreads(wanted)),
        keypoints(stages.keypoints ? stages.keypoints : std::make_shared<const ConfiguredKeypoints>()),
        descriptors(stages.descriptors ? stages.descriptors
                                       : std::make_shared<const ShotDescriptors>(DescriptorType::shot)) {}

  CapturedView describe(const TrainingSample& sample) const {
    const Cloud cloud = usablePoints(sample.load(), Orientation::sensor, settings);
    Surface surface = prepareSurface(cloud, settings.surface, Orientation::sensor, threads);
    const Keypoints found = keypoints->detect(surface, settings);
    const Descriptors rows = described(*descriptors, surface, found, settings);
    CapturedView view(std::move(surface), found, rows, settings, sample.plane);
    view.source = sample.source;
    view.T_fixed_view = sample.T_fixed_source;
    return view;
  }

  /// Whether a view is not compared with the others: without its plane only if all are to be registered.
  bool isApart(const CapturedView& view) const {
    return !view.plane && settings.training.register_views != RegisterViews::on;
  }

  /// All views are on planes, as far as they are compared.
  bool areUpright() const {
    return std::all_of(views.begin(), views.end(), [&](const CapturedView& v) { return v.plane || isApart(v); });
  }

  /// Compares the last view with those before it, in the way that all of them together are tied.
  void compareLast() {
    const std::size_t b = views.size() - 1;
    if (!areUpright()) {
      for (; related < views.size(); ++related) relate(related);
    }
    if (!views[b].plane) return;
    std::vector<UprightPair> found(b);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t a = 0; a < b; ++a) {
      if (views[a].plane) found[a] = compareUpright(views, a, b, settings.verification);
    }
    for (std::size_t a = 0; a < b; ++a) {
      if (views[a].plane) pairs.upright.push_back(found[a]);
    }
  }

  void relate(std::size_t b) {
    std::vector<std::vector<ViewRelation>> found(b);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t a = 0; a < b; ++a) found[a] = relateViews(views[a], views[b], settings, limits);
    for (std::size_t a = 0; a < b; ++a) {
      for (ViewRelation& relation : found[a]) {
        relation.a = a;
        relation.b = b;
        pairs.relations.push_back(std::move(relation));
      }
    }
  }

  std::string object;
  Settings settings;
  int threads;
  PairLimits limits;
  std::shared_ptr<const KeypointStage> keypoints;
  std::shared_ptr<const DescriptorStage> descriptors;
  std::vector<CapturedView> views;
  std::vector<std::string> sources;
  PairwiseKnowledge pairs;  // in the order of their later view
  std::size_t related = 0;  // of the first views, so many, relations are known
  EarlierTies earlier;      // of the first views
};

ObjectRegistrar::ObjectRegistrar(std::string object, const Settings& settings, const Stages& stages) {
  validate(settings);
  views_ = std::make_unique<Views>(std::move(object), settings, stages);
}
ObjectRegistrar::~ObjectRegistrar() = default;
ObjectRegistrar::ObjectRegistrar(ObjectRegistrar&&) noexcept = default;
ObjectRegistrar& ObjectRegistrar::operator=(ObjectRegistrar&&) noexcept = default;

void ObjectRegistrar::add(const TrainingSample& sample) {
  try {
    views_->views.push_back(views_->describe(sample));
  } catch (const Error& error) {
    throw Error(error.code(), sample.source + ": " + error.what());
  }
  views_->sources.push_back(sample.source);
  views_->compareLast();
}

void ObjectRegistrar::resize(std::size_t count) {
  if (count >= views_->views.size()) return;
  views_->views.erase(views_->views.begin() + std::ptrdiff_t(count), views_->views.end());
  views_->sources.resize(count);
  const auto forget = [&](auto& pairs) {
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.b >= count; }),
                pairs.end());
  };
  forget(views_->pairs.upright);
  forget(views_->pairs.relations);
  views_->related = std::min(views_->related, count);
  views_->earlier.resize(std::min(views_->earlier.size(), count + 1));
}

const std::vector<std::string>& ObjectRegistrar::sources() const {
  return views_->sources;
}

std::optional<std::size_t> ObjectRegistrar::sameAs(std::size_t view) const {
  std::optional<std::size_t> same;
  double most = same_overlap;
  const auto consider = [&](std::size_t a, const Eigen::Isometry3d& T_view_a, double overlap) {
    if (overlap < most) return;
    // Where each camera was, seen from the middle of what both show.
    const CapturedView &earlier = views_->views[a], &own = views_->views[view];
    const Eigen::Vector3d from_a = T_view_a * earlier.surface.sensor_origin.cast<double>() - own.center;
    const Eigen::Vector3d from_own = own.surface.sensor_origin.cast<double>() - own.center;
    if (from_a.normalized().dot(from_own.normalized()) < std::cos(same_direction)) return;
    most = overlap;
    same = a;
  };
  for (const ViewRelation& relation : views_->pairs.relations) {
    if (relation.b == view) consider(relation.a, relation.T_b_a, relation.agreement.overlap());
  }
  for (const UprightPair& pair : views_->pairs.upright) {
    if (pair.b != view) continue;
    const UprightAlternative& best =
        *std::max_element(pair.at_turn.begin(), pair.at_turn.end(),
                          [](const UprightAlternative& x, const UprightAlternative& y) { return x.gain < y.gain; });
    consider(pair.a, best.T_b_a, best.overlap);
  }
  return same;
}

RegisteredObject ObjectRegistrar::result() const {
  const std::vector<CapturedView>& views = views_->views;
  RegisteredObject object;
  object.object = views_->object;
  object.frame = views_->object + "#model";
  TiedViews tied =
      tieViews(views, views_->pairs, views_->settings, views_->limits, LoopLimits(), views_->threads, views_->earlier);
  object.loops = tied.loops;
  object.symmetry = tied.symmetry;
  object.on_plane = tied.axes && views[tied.axes->first].plane;
  object.model = fuseViews(views, tied.T_model_view, views_->settings);
  moveOrigin(object, tied, views_->settings.training.origin);
  for (std::size_t v = 0; v < views.size(); ++v) {
    RegisteredView view;
    view.sample = v;
    view.source = views_->sources[v];
    view.T_model_view = tied.T_model_view[v];
    view.reason = tied.reasons[v];
    if (views_->isApart(views[v])) view.reason = "the plane that it stood on is not known";
    if (view.T_model_view) view.sensor = *view.T_model_view * views[v].surface.sensor_origin.cast<double>();
    object.views.push_back(std::move(view));
  }
  return object;
}

std::size_t RegisteredObject::tied() const {
  return std::size_t(std::count_if(views.begin(), views.end(), [](const auto& v) { return bool(v.T_model_view); }));
}

}  // namespace sks
