#pragma once
/// From a C++ type to the kind of stage it is, settled when it compiles.

#include <type_traits>

#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"
#include "maggic/sink.hpp"
#include "maggic/source.hpp"
#include "maggic/tracker.hpp"

namespace maggic {

/// The kind of a class that derives from one of the five, or is one of them. Other classes do not
/// compile.
template <class T>
constexpr StageKind stage_kind_of() {
  if constexpr (std::is_base_of_v<Source, T>)
    return StageKind::kSource;
  else if constexpr (std::is_base_of_v<Normalizer, T>)
    return StageKind::kNormalizer;
  else if constexpr (std::is_base_of_v<Segmenter, T>)
    return StageKind::kSegmenter;
  else if constexpr (std::is_base_of_v<Tracker, T>)
    return StageKind::kTracker;
  else {
    static_assert(std::is_base_of_v<Sink, T>, "a plugin derives from one of the stage kinds");
    return StageKind::kSink;
  }
}

/// One of the five themselves. Of a stage the registry made no more is known: that a Normalizer is
/// a ColorNormalizer, say, a pointer to Normalizer does not promise.
template <class T>
concept StageInterface = std::is_same_v<T, Source> || std::is_same_v<T, Normalizer> ||
    std::is_same_v<T, Segmenter> || std::is_same_v<T, Tracker> || std::is_same_v<T, Sink>;

template <StageInterface T>
inline constexpr StageKind kStageKindOf = stage_kind_of<T>();

}  // namespace maggic
