#pragma once
/// Pictures with a picture of labels beside each, from disk.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "maggic/label_sweep.hpp"
#include "maggic/palette.hpp"
#include "maggic/plugin_registry.hpp"

namespace maggic::app {

/// NAME.png with NAME.labels.png (whatever extension the picture has).
struct LabelledPicture {
  std::filesystem::path picture;
  std::filesystem::path labels;
};

struct LabelledPictures {
  std::vector<LabelledPicture> pairs;  ///< By name.
  std::size_t unlabelled = 0;          ///< Pictures without labels beside them.
};

/// @param where a folder, or a pattern such as `set/00*.png`.
/// @throws std::invalid_argument when nothing is found, saying what was looked for.
LabelledPictures find_labelled_pictures(const std::string& where);

/// Reads both pictures, through the plugin `images` (so that no other command loads the codecs),
/// and counts their pixels. @throws std::invalid_argument naming the file.
void add_picture(const LabelledPicture& files, const Palette& palette, PluginRegistry& registry,
                 LabelledColors& colors);

}  // namespace maggic::app
