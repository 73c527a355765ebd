// The live inputs of a window: what is asked for is opened, listened to by threads, and handed over as
// commands when the window asks. Nothing is opened, and no library loaded, for what nobody asked for.
#pragma once

#include "cli/view/said_once.hpp"
#include "live/command.hpp"
#include "live/inputs/receiver.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// As they are typed.
struct LiveInputRequest {
    std::optional<std::string> osc{}; ///< PORT or HOST:PORT

    bool any() const { return osc.has_value(); }
};

class LiveInputs {
public:
    /// Wakes the window, which must live longer, and says where it listens. Fails where an input cannot be
    /// had.
    static Result<std::unique_ptr<LiveInputs>> open(const LiveInputRequest& request);

    /// Whether `take` has anything to give.
    bool any() { return !osc_.empty(); }
    /// What was asked for since the last call, of a scene whose knobs are turned so.
    live::Commands take(std::vector<scene::Knob> knobs);

private:
    explicit LiveInputs(void (*wake)());
    Result<void> open_osc(const std::string& where);
    void take_osc(live::Commands& commands, std::vector<scene::Knob>& knobs);

    live::Inbox osc_;
    std::unique_ptr<live::Receiver> osc_receiver_; ///< after what it puts packets into
    SaidOnce words_;
};

} // namespace tidemark::cli
