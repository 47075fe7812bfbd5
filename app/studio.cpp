/// `maggic studio`: run the pipeline, and serve a page to watch and tune it with.

#include <atomic>
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/pipeline_notes.hpp"
#include "app/pipeline_options.hpp"
#include "app/stop_signals.hpp"
#include "maggic/runner.hpp"
#include "studio/server/server.hpp"
#include "studio/session/live_session.hpp"

namespace maggic::app {
namespace {

/// Runs until the source ends or `stop`.
/// @return false when the source or a stage failed; that has been reported.
bool run_with(studio::LiveSession& session, BuiltPipeline& built, const std::atomic<bool>& stop,
              Reporter& reporter) {
  // At its own pace even when recorded: somebody watches.
  const RunSummary summary = run(built, {.realtime = true}, stop, reporter,
                                 [&session](const FrameResult& result, const RunSummary& so_far) {
                                   session.on_frame(result, so_far);
                                 });
  return summary.clean() && summary.taken() > 0;
}

}  // namespace

ExitCode studio_command(const StudioOptions& options, const CommandLine& line) {
  const PipelineRequest request = make_request(options.pipeline);
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  BuiltPipeline built = build_pipeline(request, registry, reporter);
  const bool stdout_taken = writes_to_stdout(checked_document(request));
  print_notes(built, options.pipeline, request, console);

  const std::atomic<bool>& stop = stop_on_signals();
  try {
    studio::LiveSession session(request, built, registry, reporter, stop);
    studio::Server server(session, {.listen = options.listen, .port = options.port});
    std::FILE* const out = stdout_taken ? stderr : stdout;
    fmt::print(out, "Studio: {}\n", server.url());
    std::fflush(out);

    const bool fine = run_with(session, built, stop, reporter);
    if (!stop) {
      const char* const text = fine ? "the source has ended; Ctrl-C ends the Studio"
                                    : "the run has failed, see above; Ctrl-C ends the Studio";
      console.line(text, fine ? Console::Tone::kWarning : Console::Tone::kError, "note: ");
      session.tell(fine ? "note" : "error", text);
      session.stay_with_last_frame();
    }
    server.stop();
    reporter.print_totals();
    return fine ? kFine : kFailed;
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
}

}  // namespace maggic::app
