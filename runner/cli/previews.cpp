#include "cli/previews.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

constexpr const char* k_own_program = "/proc/self/exe";
/// A page is ready before its scene is compiled, so only the driver's start takes time.
constexpr std::chrono::seconds k_preview_patience{60};
constexpr std::chrono::seconds k_grace{1};
constexpr size_t k_longest_words = 4096;

/// Levels of the protocol's messages.
enum class MessageType { error = 1, log = 4 };

std::string editor_message(std::string_view method, MessageType type, std::string_view text) {
    return lsp::framed(lsp::notification(method, {{"type", int(type)}, {"message", text}}));
}

/// Returns the response to open_preview, from the address that `tidemark serve` prints:
/// `http://127.0.0.1:8080/?token=…`.
std::optional<lsp::Json> address_in(std::string_view line) {
    const size_t query = line.find("/?token=");
    const size_t colon = line.rfind(':', query);
    if (query == line.npos || colon == line.npos)
        return std::nullopt;
    const auto port = number_from<int>(line.substr(colon + 1, query - colon - 1));
    const std::string token(line.substr(query + 8));
    if (!port)
        return std::nullopt;
    return lsp::Json{{"url", fmt::format("{}/#token={}", line.substr(0, query), token)},
                     {"token", token},
                     {"port", *port}};
}

std::string texts_line(lsp::Json texts, const std::optional<std::string>& note = {}) {
    lsp::Json line{{"texts", std::move(texts)}};
    if (note)
        line["note"] = *note;
    return line.dump(-1, ' ', false, lsp::Json::error_handler_t::replace) + "\n";
}

/// Returns the line that turns the texts `before` into `now`; empty if they are equal.
std::string difference(const scene::UnsavedTexts& before, const scene::UnsavedTexts& now) {
    lsp::Json texts = lsp::Json::object();
    for (const auto& [file, text] : now)
        if (const auto old = before.find(file); old == before.end() || old->second != text)
            texts[file.string()] = text;
    for (const auto& [file, text] : before)
        if (!now.contains(file))
            texts[file.string()] = nullptr;
    return texts.empty() ? "" : texts_line(std::move(texts));
}

bool contains_all(const std::vector<std::string>& all, const std::vector<std::string>& wanted) {
    return std::ranges::all_of(
        wanted, [&](const std::string& each) { return std::ranges::find(all, each) != all.end(); });
}

} // namespace

Previews::~Previews() {
    for (Preview& preview : previews_) {
        preview.process.close_input();
        preview.process.terminate();
    }
    const auto until = Clock::now() + k_grace;
    for (const Preview& preview : previews_)
        (void)preview.process.ends_before(until);
}

Previews::Preview* Previews::find(lsp::Order::Kind kind, const std::filesystem::path& scene) {
    const auto found = std::ranges::find_if(
        previews_, [&](const Preview& each) { return each.kind == kind && each.scene == scene; });
    return found == previews_.end() ? nullptr : &*found;
}

std::string Previews::obey(const lsp::Order& order, const scene::UnsavedTexts& texts) {
    Preview* const open =
        find(order.kind == lsp::Order::Kind::open_window ? order.kind : lsp::Order::Kind::open_preview,
             order.scene);
    const bool fits =
        open && contains_all(open->ancestors, order.ancestors) && contains_all(open->origins, order.origins);
    if (order.kind == lsp::Order::Kind::open_window)
        return open ? lsp::framed(lsp::response(order.id, nullptr)) : start(order, texts);
    if (order.kind == lsp::Order::Kind::open_preview && fits) {
        if (open->address)
            return lsp::framed(lsp::response(order.id, *open->address));
        open->waiting.push_back(order.id);
        return "";
    }
    std::string said;
    lsp::Order next = order;
    int port = 0;
    if (open) {
        next.ancestors.insert(next.ancestors.end(), open->ancestors.begin(), open->ancestors.end());
        next.origins.insert(next.origins.end(), open->origins.begin(), open->origins.end());
        if (open->address)
            port = open->address->at("port"); // a forwarded address stays valid
        for (const lsp::Json& id : open->waiting)
            said += lsp::framed(
                lsp::error_response(id, lsp::ErrorNumber::request_failed, "the preview was closed"));
        open->process.close_input();
        open->process.terminate();
        (void)open->process.ends_before(Clock::now() + k_grace);
        std::erase_if(previews_, [&](const Preview& each) { return &each == open; });
    }
    return said + (order.kind == lsp::Order::Kind::close_preview
                       ? lsp::framed(lsp::response(order.id, nullptr))
                       : start(next, texts, port));
}

std::string Previews::start(const lsp::Order& order, const scene::UnsavedTexts& texts, int port) {
    const bool window = order.kind == lsp::Order::Kind::open_window;
    std::vector<std::string> words{k_own_program, window ? "view" : "serve", order.scene.string(),
                                   "--editor"};
    words.insert(words.end(), options_.begin(), options_.end());
    for (const std::string& ancestor : order.ancestors)
        words.insert(words.end(), {"--frame-ancestor", ancestor});
    for (const std::string& origin : order.origins)
        words.insert(words.end(), {"--allow-origin", origin});
    if (port != 0)
        words.insert(words.end(), {"--port", std::to_string(port)});
    auto process = ChildProcess::start(words, ChildProcess::Input::written, "");
    if (!process)
        return lsp::framed(
            lsp::error_response(order.id, lsp::ErrorNumber::request_failed, process.error().message));
    Preview& made = previews_.emplace_back(
        Preview{order.kind, order.scene, order.ancestors, order.origins, *std::move(process)});
    made.unsent = difference({}, texts);
    if (made.unsent.empty())
        made.unsent = texts_line(lsp::Json::object()); // the process waits for its first line
    made.sent = texts;
    if (const auto note = notes_.find(order.scene); note != notes_.end())
        made.next_note = note->second;
    push(made);
    if (window)
        return lsp::framed(lsp::response(order.id, nullptr));
    made.waiting.push_back(order.id);
    return "";
}

/// Writes what the process takes now.
void Previews::push(Preview& preview) {
    while (true) {
        if (preview.unsent.empty() && preview.next) {
            preview.unsent = difference(preview.sent, *preview.next);
            preview.sent = *std::exchange(preview.next, std::nullopt);
        }
        if (preview.unsent.empty() && preview.next_note)
            preview.unsent = texts_line(lsp::Json::object(), std::exchange(preview.next_note, std::nullopt));
        if (preview.unsent.empty())
            return;
        const size_t count = preview.process.write_some(preview.unsent);
        if (count == 0)
            return;
        preview.unsent.erase(0, count);
    }
}

void Previews::send(const scene::UnsavedTexts& texts) {
    for (Preview& preview : previews_) {
        preview.next = texts;
        push(preview);
    }
}

void Previews::note(const std::filesystem::path& scene, const std::string& words) {
    notes_[scene] = words;
    for (Preview& preview : previews_)
        if (preview.scene == scene) {
            preview.next_note = words;
            push(preview);
        }
}

/// Reads what the process has printed; returns responses that waited for the address, and the lines of
/// standard error as log messages.
std::string Previews::hear(Preview& preview) {
    std::string said;
    preview.process.read_words(preview.words);
    for (size_t end; (end = preview.words.find('\n')) != std::string::npos;) {
        preview.last_words = preview.words.substr(0, end);
        preview.words.erase(0, end + 1);
        said += editor_message("window/logMessage", MessageType::log,
                               fmt::format("{}: {}", preview.name(), preview.last_words));
    }
    if (preview.words.size() > k_longest_words)
        preview.words.clear();
    if (preview.address)
        return said;
    const size_t end = preview.printed.find('\n');
    if (end != std::string::npos)
        preview.address = address_in(std::string_view(preview.printed).substr(0, end));
    if (preview.address)
        for (const lsp::Json& id : std::exchange(preview.waiting, {}))
            said += lsp::framed(lsp::response(id, *preview.address));
    return said;
}

/// Reports that the process has ended, unless the user closed its window.
std::string Previews::end(Preview& preview) {
    const bool ended = preview.process.ends_before(Clock::now() + k_grace);
    std::string said = hear(preview);
    if (ended && preview.process.succeeded() && preview.waiting.empty())
        return said;
    constexpr std::string_view k_prefix = "tidemark: error: ";
    std::string_view why = preview.last_words;
    if (why.starts_with(k_prefix))
        why.remove_prefix(k_prefix.size());
    const std::string what = fmt::format("the {} of {} has ended{}{}",
                                         preview.kind == lsp::Order::Kind::open_window ? "window" : "preview",
                                         preview.name(), why.empty() ? "" : ": ", why);
    for (const lsp::Json& id : preview.waiting)
        said += lsp::framed(lsp::error_response(id, lsp::ErrorNumber::request_failed, what));
    if (preview.waiting.empty())
        said += editor_message("window/showMessage", MessageType::error, what);
    return said;
}

std::string Previews::look() {
    std::string said;
    for (auto preview = previews_.begin(); preview != previews_.end();) {
        push(*preview);
        const bool goes_on = preview->process.read_output(preview->printed) &&
                             (preview->waiting.empty() || Clock::now() < preview->begun + k_preview_patience);
        if (preview->address)
            preview->printed.clear();
        said += goes_on ? hear(*preview) : end(*preview);
        preview = goes_on ? preview + 1 : previews_.erase(preview);
    }
    return said;
}

void Previews::add_to(std::vector<pollfd>& waits) const {
    for (const Preview& preview : previews_) {
        const auto [input, output, words] = preview.process.streams();
        waits.push_back({output, POLLIN, 0});
        waits.push_back({words, POLLIN, 0});
        if (!preview.unsent.empty())
            waits.push_back({input, POLLOUT, 0});
    }
}

bool Previews::waits() const {
    return std::ranges::any_of(previews_, [](const Preview& each) { return !each.waiting.empty(); });
}

} // namespace tidemark::cli
