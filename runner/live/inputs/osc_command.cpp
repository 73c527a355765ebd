#include "live/inputs/osc_command.hpp"

#include "base/try.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tidemark::live {
namespace {

constexpr std::string_view k_knob = "/knob/";

template <class... Words>
tl::unexpected<Error> refuse(fmt::format_string<Words...> form, Words&&... words) {
    return fail(ErrorCode::usage, "OSC: " + fmt::format(form, std::forward<Words>(words)...));
}

/// Returns the number in a message with exactly one argument.
std::optional<double> number_of(const OscMessage& message) {
    if (message.arguments.size() != 1)
        return std::nullopt;
    const auto* number = std::get_if<double>(message.arguments.data());
    return number ? std::optional(*number) : std::nullopt;
}

std::optional<size_t> component_of(std::string_view name, const scene::Knob& knob) {
    constexpr std::string_view k_letters[] = {"xyzw", "rgba"};
    for (const std::string_view letters : k_letters)
        if (const size_t at = letters.find(name); name.size() == 1 && at < size_t(info(knob.type).components))
            return at;
    return std::nullopt;
}

/// Returns an argument as --set takes it; numbers for a whole-number knob are rounded, as faders send
/// fractions.
std::string word_of(const scene::Knob& knob, const OscArgument& argument) {
    if (const auto* text = std::get_if<std::string>(&argument))
        return *text;
    const double number = std::get<double>(argument);
    return fmt::format("{}", info(knob.type).whole ? std::round(number) : number);
}

/// Parses the values with the same rules as `--set`.
Result<scene::KnobValue> value_of(const scene::Knob& knob, std::span<const OscArgument> arguments) {
    std::vector<std::string> words;
    for (const OscArgument& argument : arguments)
        words.push_back(word_of(knob, argument));
    auto value = parse_knob_value(knob, fmt::format("{}", fmt::join(words, ",")));
    if (!value)
        return refuse("{}", value.error().message);
    return value;
}

Result<Command> turn_component(const scene::Knob& knob, std::string_view name, const OscMessage& message) {
    const auto component = component_of(name, knob);
    if (!component)
        return refuse("{} ({}) has no component '{}'", knob.name, info(knob.type).directive_name, name);
    if (!number_of(message))
        return refuse("'{}' takes one number", message.address);
    scene::KnobValue value = knob.value;
    value[*component] = TRY(value_of(knob, message.arguments))[*component];
    return TurnKnob{knob.name, value};
}

Result<Command> turn(const OscMessage& message, std::span<const scene::Knob> knobs) {
    const std::string_view rest = std::string_view(message.address).substr(k_knob.size());
    const size_t slash = rest.find('/');
    const std::string_view name = rest.substr(0, slash);
    const auto knob = std::ranges::find(knobs, name, &scene::Knob::name);
    if (knob == knobs.end()) {
        std::vector<scene::Knob> named(knobs.begin(), knobs.end());
        return refuse("{}", find_knob(named, name).error().message);
    }
    if (slash != rest.npos)
        return turn_component(*knob, rest.substr(slash + 1), message);
    const auto value = TRY(value_of(*knob, message.arguments));
    return TurnKnob{knob->name, value};
}

Result<Command> seek(const OscMessage& message) {
    const auto seconds = number_of(message);
    if (!seconds || !(*seconds >= 0))
        return refuse("/time takes one number of seconds, 0 or more");
    return Seek{*seconds};
}

Result<Command> play(const OscMessage& message) {
    const auto number = message.arguments.empty() ? std::optional(1.0) : number_of(message);
    if (!number)
        return refuse("/play takes 1 or 0");
    return SetPlaying{*number != 0};
}

} // namespace

Result<Command> osc_command(const OscMessage& message, std::span<const scene::Knob> knobs) {
    if (message.address.starts_with(k_knob))
        return turn(message, knobs);
    if (message.address == "/time")
        return seek(message);
    if (message.address == "/play")
        return play(message);
    return refuse("'{}' means nothing here: send /knob/NAME, /time or /play", message.address);
}

} // namespace tidemark::live
