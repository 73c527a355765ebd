#include "web/request.hpp"

#include "base/encoding.hpp"
#include "host/overlay_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>

namespace tidemark::web {
namespace {

constexpr std::string_view k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr size_t k_token_letters = 22; // each holds 6 bits
constexpr size_t k_shortest = 16;
constexpr size_t k_longest = 128;

/// Returns the value of `token` in a query; nothing if the query has none.
std::optional<std::string_view> token_in(std::string_view query) {
    constexpr std::string_view k_name = "token=";
    while (!query.empty()) {
        const size_t end = std::min(query.find('&'), query.size());
        if (query.starts_with(k_name))
            return query.substr(k_name.size(), end - k_name.size());
        query.remove_prefix(std::min(end + 1, query.size()));
    }
    return std::nullopt;
}

/// Returns the host without the port.
std::string_view name_of(std::string_view host) {
    if (host.starts_with('['))
        return host.substr(0, host.find(']') + 1);
    return host.substr(0, host.find(':'));
}

bool is_loopback_name(std::string_view name) {
    const bool is_number = name.find_first_not_of("0123456789.") == std::string_view::npos;
    return name == "localhost" || name.ends_with(".localhost") || name == "[::1]" ||
           (is_number && name.starts_with("127."));
}

/// Returns whether an origin is `http://HOST` or `https://HOST` with that host.
bool is_own(std::string_view origin, std::string_view host) {
    const size_t scheme = origin.find("://");
    const std::string_view name = origin.substr(0, scheme);
    return scheme != std::string_view::npos && (name == "http" || name == "https") &&
           origin.substr(scheme + 3) == host;
}

/// Returns whether the host is that of one of the origins.
bool is_host_of(std::span<const std::string> origins, std::string_view host) {
    return std::ranges::any_of(origins, [&](std::string_view origin) { return is_own(origin, host); });
}

bool consists_of(std::string_view text, std::string_view others) {
    return !text.empty() && std::ranges::all_of(text, [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || others.find(c) != others.npos;
    });
}

bool is_port(std::string_view text) {
    const auto port = number_from<int>(text);
    return port && *port >= 1 && *port <= 65535;
}

/// Returns whether the text is a host with an optional port, in small letters as browsers send it.
bool is_authority(std::string_view text) {
    if (text.starts_with('[')) {
        const size_t close = std::min(text.find(']'), text.size());
        const std::string_view rest = text.substr(std::min(close + 1, text.size()));
        return consists_of(text.substr(1, close - 1), ":.") && close < text.size() &&
               (rest.empty() || (rest.front() == ':' && is_port(rest.substr(1))));
    }
    const size_t colon = std::min(text.find(':'), text.size());
    const std::string_view host = text.substr(0, colon);
    return consists_of(host, "-._") && host.front() != '.' && host.find("..") == host.npos &&
           (colon == text.size() || is_port(text.substr(colon + 1)));
}

/// Schemes that any page of the web has, or that have no origin.
constexpr std::string_view k_open_schemes[] = {"http", "https",      "ws",   "wss",        "data",
                                               "blob", "filesystem", "file", "javascript", "about"};

using Json = nlohmann::ordered_json;
using host::Button;
using host::Key;

/// Floats represent every integer up to here.
constexpr double k_farthest_pixel = 1 << 24;
constexpr double k_most_notches = 1000;
constexpr size_t k_longest_name = 256;

tl::unexpected<Error> refused(std::string_view name, std::string_view wanted) {
    return fail(ErrorCode::usage, fmt::format("\"{}\": give {}", name, wanted));
}

/// Returns a finite number whose absolute value is at most `most`.
Result<double> number(const Json& message, const char* name, double most) {
    const auto found = message.find(name);
    if (found == message.end() || !found->is_number() || !(std::abs(found->get<double>()) <= most))
        return refused(name, fmt::format("a number within {:g}", most));
    return found->get<double>();
}

Result<int> whole_number(const Json& message, const char* name, int least, int most) {
    const auto found = message.find(name);
    if (found == message.end() || !found->is_number_integer() || found->get<int64_t>() < least ||
        found->get<int64_t>() > most)
        return refused(name, fmt::format("a whole number from {} to {}", least, most));
    return found->get<int>();
}

Result<std::string> name_in(const Json& message, const char* name) {
    const auto found = message.find(name);
    if (found == message.end() || !found->is_string() ||
        found->get_ref<const std::string&>().size() > k_longest_name)
        return refused(name, fmt::format("a text of at most {} bytes", k_longest_name));
    return found->get<std::string>();
}

/// Returns a GLSL identifier; others are refused, since it is written into commands and searched for in
/// files.
Result<std::string> identifier_in(const Json& message) {
    const std::string name = TRY(name_in(message, "name"));
    const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) ||
        !std::ranges::all_of(name, is_letter))
        return refused("name", "a name of letters, digits and _");
    return name;
}

Result<host::PointerPosition> place(const Json& message) {
    const double x = TRY(number(message, "x", k_farthest_pixel));
    return host::PointerPosition{x, TRY(number(message, "y", k_farthest_pixel))};
}

Result<Button> button(const Json& message) {
    const std::string name = TRY(name_in(message, "button"));
    if (name == "left")
        return Button::left;
    if (name == "middle")
        return Button::middle;
    if (name == "right")
        return Button::right;
    return refused("button", "left, middle or right");
}

Result<Key> key(const Json& message) {
    return whole_number(message, "code", 1, 255).map([](int code) { return Key(code); });
}

template <class T>
Request event(T happened) {
    return host::InputEvent(std::move(happened));
}

template <class T>
Request command(T wanted) {
    return overlay::Command(std::move(wanted));
}

Result<Request> turn_knob(const Json& message) {
    overlay::TurnKnob turn{TRY(identifier_in(message))};
    const auto values = message.find("value");
    if (values == message.end() || !values->is_array() || values->empty() ||
        values->size() > turn.value.size() ||
        !std::ranges::all_of(*values, [](const Json& value) { return value.is_number(); }))
        return refused("value", "one to four numbers");
    for (size_t i = 0; i < values->size(); ++i)
        turn.value[i] = (*values)[i].get<double>();
    return command(std::move(turn));
}

/// Accepts only a number: other text would become part of a shader.
Result<Request> define(const Json& message) {
    overlay::Define define{TRY(identifier_in(message)), {}};
    define.value = TRY(name_in(message, "value"));
    if (!overlay::definition_field(define.name, define.value, true))
        return refused("value", "a decimal number");
    return command(std::move(define));
}

Result<Request> show_picture(const Json& message) {
    if (const auto found = message.find("picture"); found != message.end() && found->is_null())
        return command(overlay::ShowPicture{});
    const int index = TRY(whole_number(message, "picture", 0, 1000));
    return command(overlay::ShowPicture{size_t(index)});
}

/// The name of a lens with its place and its variable, which may be a file's: no blanks or quotes.
Result<Request> set_lens(const Json& message) {
    const std::string lens = TRY(name_in(message, "lens"));
    if (!std::ranges::all_of(lens, [](unsigned char c) {
            return std::isalnum(c) || std::string_view("_.:@/-+").find(char(c)) != std::string_view::npos;
        }))
        return refused("lens", "a lens such as cost or value:12:p, or an empty text");
    return command(overlay::SetLens{lens});
}

Result<std::optional<double>> time_or_null(const Json& message, const char* name) {
    if (const auto found = message.find(name); found != message.end() && found->is_null())
        return std::nullopt;
    return TRY(number(message, name, std::numeric_limits<int>::max()));
}

Result<Request> set_loop(const Json& message) {
    overlay::SetLoop loop{TRY(time_or_null(message, "from")), {}};
    loop.to = TRY(time_or_null(message, "to"));
    return command(loop);
}

using Read = Result<Request> (*)(const Json& message);
struct Verb {
    std::string_view name;
    Read read;
};

constexpr Verb k_events[] = {
    {"move", [](const Json& m) -> Result<Request> { return event(host::PointerMoved{TRY(place(m))}); }},
    {"press",
     [](const Json& m) -> Result<Request> {
         const Button pressed = TRY(button(m));
         return event(host::ButtonPressed{pressed, TRY(place(m))});
     }},
    {"release",
     [](const Json& m) -> Result<Request> {
         const Button released = TRY(button(m));
         return event(host::ButtonReleased{released, TRY(place(m))});
     }},
    {"wheel",
     [](const Json& m) -> Result<Request> {
         return event(host::WheelTurned{0, TRY(number(m, "up", k_most_notches))});
     }},
    {"keydown", [](const Json& m) -> Result<Request> { return event(host::KeyPressed{TRY(key(m))}); }},
    {"keyup", [](const Json& m) -> Result<Request> { return event(host::KeyReleased{TRY(key(m))}); }},
};

constexpr Verb k_commands[] = {
    {"turn", turn_knob},
    {"reset",
     [](const Json& m) -> Result<Request> { return command(overlay::ResetKnob{TRY(identifier_in(m))}); }},
    {"reset all", [](const Json&) -> Result<Request> { return command(overlay::ResetKnobs{}); }},
    {"copy knobs", [](const Json&) -> Result<Request> { return command(overlay::CopyKnobs{}); }},
    {"define", define},
    {"undefine",
     [](const Json& m) -> Result<Request> { return command(overlay::Undefine{TRY(identifier_in(m))}); }},
    {"show", show_picture},
    {"pause", [](const Json&) -> Result<Request> { return command(overlay::TogglePause{}); }},
    {"restart", [](const Json&) -> Result<Request> { return command(overlay::Restart{}); }},
    {"seek",
     [](const Json& m) -> Result<Request> {
         return command(overlay::Seek{TRY(number(m, "seconds", std::numeric_limits<int>::max()))});
     }},
    {"give up seek", [](const Json&) -> Result<Request> { return command(overlay::GiveUpSeek{}); }},
    {"speed",
     [](const Json& m) -> Result<Request> {
         return command(overlay::SetSpeed{TRY(number(m, "speed", 100))});
     }},
    {"loop", set_loop},
    {"lens", set_lens},
};

constexpr Verb k_of_viewers[] = {
    {"seen",
     [](const Json& m) -> Result<Request> {
         return PictureSeen{uint32_t(TRY(whole_number(m, "number", 1, std::numeric_limits<int>::max())))};
     }},
    {"steer", [](const Json&) -> Result<Request> { return SteeringWanted{}; }},
    {"let go", [](const Json&) -> Result<Request> { return LetGo{}; }},
};

/// Compares tokens in a time that does not depend on which letters differ.
bool is_same_token(std::string_view given, std::string_view right) {
    if (given.size() != right.size())
        return false; // the length is not secret
    unsigned char difference = 0;
    for (size_t i = 0; i < right.size(); ++i)
        difference |= static_cast<unsigned char>(given[i] ^ right[i]);
    return difference == 0;
}

} // namespace

Result<std::string> make_token() {
    std::array<unsigned char, k_token_letters> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
        return fail(ErrorCode::load,
                    fmt::format("the system gives no random numbers: {}", system_reason(errno)));
    std::string token;
    for (const unsigned char byte : bytes)
        token += k_letters[byte % k_letters.size()];
    return token;
}

Result<void> check_token(std::string_view token) {
    const bool good = token.find_first_not_of(k_letters) == std::string_view::npos &&
                      token.size() >= k_shortest && token.size() <= k_longest;
    if (good)
        return {};
    return fail(ErrorCode::usage, fmt::format("the token has {} characters: give {} to {} letters, digits, - "
                                              "or _, as in `openssl rand -hex 16`",
                                              token.size(), k_shortest, k_longest));
}

Result<void> check_origin(std::string_view origin) {
    const size_t scheme = origin.find("://");
    const std::string_view name = origin.substr(0, scheme);
    if (scheme != origin.npos && (name == "http" || name == "https") &&
        is_authority(origin.substr(scheme + 3)))
        return {};
    return fail(ErrorCode::usage,
                fmt::format("'{}' is no origin: give scheme, host and port in small letters, as in "
                            "https://name-8080.example.dev",
                            origin));
}

Result<void> check_ancestor(std::string_view ancestor) {
    const size_t colon = std::min(ancestor.find(':'), ancestor.size());
    const std::string_view scheme = ancestor.substr(0, colon);
    std::string_view rest = ancestor.substr(std::min(colon + 1, ancestor.size()));
    const bool has_scheme = colon < ancestor.size() && consists_of(scheme, "+-.") && scheme.front() >= 'a';
    if (has_scheme && rest.empty() && std::ranges::find(k_open_schemes, scheme) == std::end(k_open_schemes))
        return {};
    const bool has_host = has_scheme && rest.starts_with("//");
    if (has_host)
        rest.remove_prefix(rest.starts_with("//*.") ? 4 : 2);
    if (has_host && is_authority(rest))
        return {};
    return fail(ErrorCode::usage,
                fmt::format("'{}' cannot frame the page: give an origin in small letters, as in "
                            "https://editor.example or https://*.vscode-cdn.net, or the scheme of a "
                            "program's own pages, as in vscode-webview:",
                            ancestor));
}

Answer answer_to(const Knock& knock, std::string_view token, std::span<const std::string> origins) {
    const size_t question = std::min(knock.target.find('?'), knock.target.size());
    const std::string_view path = knock.target.substr(0, question);
    const std::string_view query = knock.target.substr(std::min(question + 1, knock.target.size()));
    if (knock.through_loopback && !is_loopback_name(name_of(knock.host)) && !is_host_of(origins, knock.host))
        return Answer::forbidden;
    const auto given = token_in(query);
    if (!given && path == "/" && !knock.upgrade)
        return Answer::page; // it holds no secret
    if (!is_same_token(given.value_or(""), token))
        return Answer::forbidden;
    if (knock.upgrade && !knock.origin.empty() && !is_own(knock.origin, knock.host) &&
        std::ranges::find(origins, knock.origin) == origins.end())
        return Answer::forbidden;
    if (path == "/socket" && knock.upgrade)
        return Answer::socket;
    return path == "/" && !knock.upgrade ? Answer::page : Answer::not_found;
}

Result<Request> parse_request(std::string_view message) {
    if (message.size() > k_longest_request)
        return fail(ErrorCode::usage, fmt::format("a message has at most {} bytes", k_longest_request));
    const Json json = Json::parse(message, nullptr, false);
    if (!json.is_object())
        return fail(ErrorCode::usage, "a message must be a JSON object");
    const std::string wanted = TRY(name_in(json, "do"));
    for (const std::span<const Verb> verbs :
         {std::span<const Verb>(k_events), std::span<const Verb>(k_commands),
          std::span<const Verb>(k_of_viewers)})
        if (const auto verb = std::ranges::find(verbs, wanted, &Verb::name); verb != verbs.end())
            return verb->read(json);
    return refused("do", "a known request");
}

} // namespace tidemark::web
