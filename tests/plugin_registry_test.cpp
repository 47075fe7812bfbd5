/// How plugins are found, refused and kept, with the plugins under tests/plugins/.

#include <dlfcn.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "maggic/plugin_registry.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

const fs::path kTestPlugins = MAGGIC_TEST_PLUGIN_DIR;

template <class T>
concept CanBeAskedFor = requires(PluginRegistry& registry) {
  registry.create<T>("name");
};
static_assert(CanBeAskedFor<Source> && CanBeAskedFor<Sink>);
static_assert(!CanBeAskedFor<Stage> && !CanBeAskedFor<ColorNormalizer> && !CanBeAskedFor<int>);

/// Two empty folders to put plugins into.
class PluginFolders : public ::testing::Test {
 protected:
  PluginFolders() {
    fs::create_directories(first_);
    fs::create_directories(second_);
  }
  ~PluginFolders() override { fs::remove_all(root_); }

  static fs::path put(const std::string& plugin, const fs::path& folder) {
    const fs::path file = folder / (plugin + ".so");
    fs::copy_file(kTestPlugins / file.filename(), file);
    return file;
  }
  static bool is_open(const fs::path& file) {
    void* const handle = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD);
    if (handle != nullptr) ::dlclose(handle);
    return handle != nullptr;
  }
  /// Why the only file in the first folder is refused.
  std::string reason() {
    const PluginRegistry::Scan scan = PluginRegistry({first_}).scan();
    return scan.refused.size() == 1 ? scan.refused[0].reason : "not refused";
  }
  std::string reason_of(const std::string& plugin) {
    const fs::path file = put(plugin, first_);
    const std::string text = reason();
    // What `scan` says and what a pipeline that names the plugin is told are the same words.
    EXPECT_THAT([&] { PluginRegistry({first_}).info(plugin); },
                ThrowsMessage<PluginError>(file.string() + ": " + text));
    return text;
  }

  const fs::path root_ =
      fs::path(::testing::TempDir()) / fmt::format("plugin_folders_{}", ::getpid());
  const fs::path first_ = root_ / "first";
  const fs::path second_ = root_ / "second";
};

using RefusedPlugin = PluginFolders;

TEST_F(RefusedPlugin, OfAnotherAbiNeverRunsALine) {
  EXPECT_EQ(reason_of("other_abi"),
            "is built for plugin ABI 4, this program speaks 3: build it again");
}

TEST_F(RefusedPlugin, IsALibraryButNoPlugin) {
  EXPECT_EQ(reason_of("no_plugin"),
            "is not a Maggic plugin: it does not end in a MAGGIC_PLUGIN line");
}

TEST_F(RefusedPlugin, NeedsAFunctionThatNobodyHas) {
  EXPECT_THAT(reason_of("missing_symbol"), AllOf(StartsWith("cannot be opened: undefined symbol: "),
                                                 HasSubstr("function_that_nobody_has")));
}

TEST_F(RefusedPlugin, CallsItselfOtherwiseThanItsFile) {
  EXPECT_EQ(reason_of("misnamed"),
            "calls itself 'another_name', expected 'misnamed' as the file is named");
}

TEST_F(RefusedPlugin, IsBuiltByAnotherToolchain) {
  EXPECT_THAT(reason_of("other_toolchain"),
              AllOf(StartsWith("is built with 'libc++ cxxabi 1 c++2b', this program with '"),
                    EndsWith("': build it again")));
}

TEST_F(RefusedPlugin, HasADescriptorOfAnotherSize) {
  EXPECT_THAT(reason_of("other_size"), StartsWith("has a descriptor of 4 bytes, expected "));
}

TEST_F(RefusedPlugin, ForgotToExportHowItIsMade) {
  EXPECT_EQ(reason_of("incomplete_descriptor"),
            "has an incomplete descriptor: summary, create and destroy are expected");
}

TEST_F(RefusedPlugin, IsCutShort) {
  const fs::path file = put("well_behaved", first_);
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THAT(reason(), StartsWith("is cut short or damaged"));
}

TEST_F(RefusedPlugin, IsText) {
  std::ofstream(first_ / "notes.so") << "not a library\n";
  EXPECT_EQ(reason(), "is no ELF file, expected a shared library");
}

TEST_F(RefusedPlugin, IsAFolder) {
  fs::create_directories(first_ / "x.so");
  EXPECT_EQ(reason(), "is a directory, expected a shared library");
}

TEST_F(RefusedPlugin, IsALinkToNothing) {
  fs::create_symlink(first_ / "gone", first_ / "x.so");
  EXPECT_EQ(reason(), "no such file");
}

TEST_F(RefusedPlugin, IsThereTwice) {
  const fs::path one = put("well_behaved", first_);
  const fs::path two = put("well_behaved", second_);
  PluginRegistry registry({first_, second_});
  EXPECT_THAT([&] { registry.create(StageKind::kTracker, "well_behaved"); },
              ThrowsMessage<PluginError>(fmt::format(
                  "plugin 'well_behaved' is there more than once: {} and {}; expected one of them",
                  one.string(), two.string())));
  const PluginRegistry::Scan scan = registry.scan();
  EXPECT_THAT(scan.plugins, IsEmpty());
  EXPECT_THAT(scan.refused,
              ElementsAre(Field(&PluginRefusal::file, one), Field(&PluginRefusal::file, two)));
}

TEST_F(RefusedPlugin, LeavesTheOthersWorking) {
  put("well_behaved", first_);
  put("missing_symbol", first_);
  put("other_abi", first_);
  std::ofstream(first_ / "notes.so") << "not a library\n";
  PluginRegistry registry({first_});
  const PluginRegistry::Scan scan = registry.scan();
  EXPECT_THAT(scan.plugins, ElementsAre(Field(&PluginInfo::name, "well_behaved")));
  EXPECT_EQ(scan.refused.size(), 3U);
  EXPECT_NE(registry.create(StageKind::kTracker, "well_behaved"), nullptr);
}

using Registry = PluginFolders;

TEST_F(Registry, TellsWhatAPluginIs) {
  const fs::path file = put("well_behaved", first_);
  const PluginInfo info = PluginRegistry({first_}).info("well_behaved");
  EXPECT_EQ(info.name, "well_behaved");
  EXPECT_EQ(info.kind, StageKind::kTracker);
  EXPECT_EQ(info.summary, "finds nothing, correctly");
  EXPECT_EQ(info.file, file);
}

TEST_F(Registry, NamesTheKnownPluginsAndFoldersWhenThereIsNone) {
  put("well_behaved", first_);
  put("throwing_constructor", first_);
  PluginRegistry registry({first_, second_});
  EXPECT_THAT([&] { registry.info("well_behavd"); },
              ThrowsMessage<PluginError>(fmt::format(
                  "there is no plugin 'well_behavd' (known: throwing_constructor, well_behaved; "
                  "searched: {}, {})",
                  first_.string(), second_.string())));
  EXPECT_THAT([&] { registry.info("../first/well_behaved"); },
              ThrowsMessage<PluginError>(HasSubstr("there is no plugin")));
}

TEST_F(Registry, RefusesAPluginOfAnotherKind) {
  const fs::path file = put("well_behaved", first_);
  EXPECT_THAT([&] { PluginRegistry({first_}).create(StageKind::kSegmenter, "well_behaved"); },
              ThrowsMessage<PluginError>(fmt::format(
                  "plugin 'well_behaved' ({}) is a tracker, expected a segmenter", file.string())));
}

TEST_F(Registry, ReportsAConstructorThatThrows) {
  const fs::path file = put("throwing_constructor", first_);
  std::optional<PluginError> error;
  {
    PluginRegistry registry({first_});
    try {
      registry.create(StageKind::kTracker, "throwing_constructor");
    } catch (const PluginError& caught) {
      error = caught;
    }
  }
  // The registry is gone, and with it perhaps the library whose exception this was.
  ASSERT_TRUE(error.has_value());
  EXPECT_STREQ(error->what(),
               fmt::format("plugin 'throwing_constructor' ({}) cannot be created: the camera club "
                           "has the key",
                           file.string())
                   .c_str());
}

TEST_F(Registry, OpensOnlyTheLibraryThatIsAskedFor) {
  const fs::path asked = put("well_behaved", first_);
  const fs::path other = put("throwing_constructor", first_);
  PluginRegistry registry({first_});
  EXPECT_FALSE(is_open(asked));
  const auto stage = registry.create(StageKind::kTracker, "well_behaved");
  EXPECT_TRUE(is_open(asked));
  EXPECT_FALSE(is_open(other));
}

TEST_F(Registry, LeavesAStageItsLibrary) {
  put("well_behaved", first_);
  StagePtr<Tracker> stage;
  {
    PluginRegistry registry({first_});
    stage = registry.create<Tracker>("well_behaved");
  }
  Detections out;
  const maggic::Field field(FieldParameters{}, cv::Size(64, 48));
  stage->track({7, Timestamp(5), {}, field}, out);
  EXPECT_EQ(out.sequence, 7U);
}

TEST_F(Registry, CountsAFolderOnceHoweverItIsNamed) {
  put("well_behaved", first_);
  fs::create_directory_symlink(first_, root_ / "link");
  PluginRegistry registry({first_, root_ / "link", root_ / "second/../first", root_ / "missing"});
  EXPECT_EQ(registry.info("well_behaved").kind, StageKind::kTracker);
}

TEST_F(Registry, SearchesFoldersThatAreAddedLater) {
  put("well_behaved", second_);
  PluginRegistry registry({first_});
  EXPECT_THROW(registry.info("well_behaved"), PluginError);
  registry.add_folder(second_);
  EXPECT_EQ(registry.info("well_behaved").name, "well_behaved");
}

TEST_F(Registry, SearchesTheEnvironmentsFoldersFirst) {
  const char* const before = std::getenv("MAGGIC_PLUGIN_PATH");
  const std::optional<std::string> saved =
      before ? std::optional<std::string>(before) : std::nullopt;
  ::setenv("MAGGIC_PLUGIN_PATH", "/one::/two", 1);
  const std::vector<fs::path> folders = PluginRegistry::default_folders();
  if (saved) {
    ::setenv("MAGGIC_PLUGIN_PATH", saved->c_str(), 1);
  } else {
    ::unsetenv("MAGGIC_PLUGIN_PATH");
  }
  ASSERT_EQ(folders.size(), 3U);
  EXPECT_EQ(folders[0], "/one");
  EXPECT_EQ(folders[1], "/two");
  EXPECT_THAT(folders[2].string(), EndsWith("lib/maggic/plugins"));
}

TEST_F(Registry, ScansTheKindsInTheOrderOfThePipeline) {
  for (const char* plugin : {"well_behaved", "demanding_sink", "restless_source",
                             "foreign_label_segmenter", "batch_dependent_normalizer"}) {
    put(plugin, first_);
  }
  const auto is = [](StageKind kind) { return Field(&PluginInfo::kind, kind); };
  EXPECT_THAT(
      PluginRegistry({first_}).scan().plugins,
      ElementsAre(is(StageKind::kSource), is(StageKind::kNormalizer), is(StageKind::kSegmenter),
                  is(StageKind::kTracker), is(StageKind::kSink)));
}

}  // namespace
}  // namespace maggic
