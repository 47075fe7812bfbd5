#pragma once
/// The paths under `/api`.

#include "studio/server/routes.hpp"
#include "studio/server/stop_flag.hpp"
#include "studio/server/stream_slots.hpp"
#include "studio/session/session.hpp"

namespace maggic::studio {

/// What the handlers work on; outlives them.
struct ApiContext {
  Session& session;
  StreamSlots& picture_slots;
  StreamSlots& event_slots;
  const StopFlag& stop;
};

/// Handlers throw BadRequest for what cannot be done, and what the session throws.
void add_api_routes(Routes& routes, const ApiContext& context);

}  // namespace maggic::studio
