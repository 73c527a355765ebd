#include "lsp/session.hpp"

#include "base/uri.hpp"
#include "lsp/scene_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

std::string joined(const std::vector<Json>& messages) {
    std::string text;
    for (const Json& message : messages)
        text += framed(message);
    return text;
}

/// Returns nothing for a URI that is not a file of this machine.
std::optional<fs::path> file_of(const Json& params) {
    const auto file = path_of_uri(params.at("textDocument").at("uri").get<std::string>());
    return file ? std::optional(canonical_name(*file)) : std::nullopt;
}

bool offers_utf8(const Json& params) {
    const Json offered = params.value("/capabilities/general/positionEncodings"_json_pointer, Json::array());
    return std::ranges::find(offered, Json("utf-8")) != offered.end();
}

/// Returns the member, or null if the object does not have it.
Json member(const Json& object, const char* name) {
    return object.is_object() && object.contains(name) ? object[name] : Json();
}

} // namespace

std::string Session::receive(std::string_view text) {
    const Json message = Json::parse(text, nullptr, false);
    if (message.is_discarded())
        return framed(error_response(nullptr, ErrorNumber::parse_error, "the message is no JSON"));
    if (!message.is_object() || !member(message, "method").is_string())
        return message.is_object() && message.contains("result")
                   ? "" // a response, although no request was sent
                   : framed(error_response(nullptr, ErrorNumber::invalid_request,
                                           "a message is an object with a method"));
    return answer(message);
}

std::string Session::answer(const Json& message) {
    const std::string method = message["method"];
    const Json params = member(message, "params");
    const bool asks = message.contains("id");
    const Json id = member(message, "id");
    try { // a member is missing or has another type
        if (!asks)
            return notified(method, params);
        Answer result = request(method, params);
        return framed(result ? response(id, *std::move(result))
                             : error_response(id, result.error().number, result.error().message));
    } catch (const Json::exception& wrong) {
        const std::string words = fmt::format("{}: {}", method, wrong.what());
        return asks ? framed(error_response(id, ErrorNumber::invalid_params, words))
                    : framed(notification("window/logMessage", {{"type", 2}, {"message", words}}));
    }
}

Answer Session::request(const std::string& method, const Json& params) {
    if (method == "initialize")
        return initialize(params);
    if (phase_ == Phase::fresh)
        return refuse(ErrorNumber::not_initialized, "`initialize` comes first");
    if (phase_ == Phase::shut_down)
        return refuse(ErrorNumber::invalid_request, "after `shutdown` there is only `exit`");
    if (method != "shutdown")
        return ask(method, params);
    phase_ = Phase::shut_down;
    return Json();
}

/// Answers a request about a document.
Answer Session::ask(const std::string& method, const Json& params) const {
    const AnswerTo question = find_question(method);
    if (!question)
        return refuse(ErrorNumber::method_not_found, fmt::format("there is no {} here", method));
    return workspace_of(params).and_then([&](const Workspace& workspace) -> Answer {
        if (workspace.files.front().path.extension() ==
            ".json") // its text is no GLSL: it has diagnostics alone
            return Json();
        return question({workspace, params, documents_, encoding_});
    });
}

std::string Session::notified(const std::string& method, const Json& params) {
    if (method == "exit")
        exit_code_ = phase_ == Phase::shut_down ? 0 : 1;
    if (phase_ != Phase::running)
        return "";
    if (method == "textDocument/didOpen")
        return open(params);
    if (method == "textDocument/didChange")
        return change(params);
    if (method == "textDocument/didClose")
        return close(params);
    if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles")
        saved();
    return "";
}

Answer Session::initialize(const Json& params) {
    if (phase_ != Phase::fresh)
        return refuse(ErrorNumber::invalid_request, "`initialize` comes once");
    encoding_ = offers_utf8(params.is_object() ? params : Json::object()) ? Encoding::utf8 : Encoding::utf16;
    phase_ = Phase::running;
    constexpr int k_whole_texts = 1;
    return Json{{"serverInfo", {{"name", "tidemark"}, {"version", version_}}},
                {"capabilities",
                 {{"positionEncoding", encoding_ == Encoding::utf8 ? "utf-8" : "utf-16"},
                  {"textDocumentSync", {{"openClose", true}, {"change", k_whole_texts}, {"save", true}}},
                  {"hoverProvider", true},
                  {"definitionProvider", true},
                  {"documentSymbolProvider", true},
                  {"colorProvider", true},
                  {"renameProvider", {{"prepareProvider", true}}}}}};
}

tl::expected<Workspace, Refusal> Session::workspace_of(const Json& params) const {
    const auto file = file_of(params);
    if (!file)
        return refuse(ErrorNumber::invalid_params,
                      fmt::format("{} names no file of this machine: only file: URIs can be read",
                                  params["textDocument"]["uri"].dump()));
    if (const auto text = documents_.text_of(*file); !text)
        return refuse(ErrorNumber::invalid_params, text.error().message);
    const auto known = scenes_.find(*file);
    return look_around(*file, known == scenes_.end() ? std::nullopt : std::optional(known->second),
                       documents_);
}

std::string Session::open(const Json& params) {
    const Json& document = params.at("textDocument");
    const auto file = file_of(params);
    if (!file)
        return ""; // a text without a file has no scene
    documents_.hold(*file, {document.at("uri"), document.value("version", 0)},
                    document.at("text").get<std::string>());
    return take_up(*file);
}

std::string Session::change(const Json& params) {
    const auto file = file_of(params);
    const Json& changes = params.at("contentChanges");
    if (!file || !documents_.find(*file) || changes.empty())
        return "";
    const Json& document = params["textDocument"];
    documents_.hold(*file, {document["uri"], document.value("version", 0)},
                    changes.back().at("text").get<std::string>());
    ++edits_;
    return take_up(*file);
}

std::string Session::close(const Json& params) {
    const auto file = file_of(params);
    const auto known = file ? scenes_.find(*file) : scenes_.end();
    if (file)
        documents_.release(*file);
    if (known == scenes_.end())
        return "";
    const fs::path scene = known->second;
    scenes_.erase(known);
    return leave(scene);
}

void Session::saved() {
    files_of_.clear();
    for (const auto& [file, scene] : scenes_)
        stale_.insert(scene);
}

/// Assigns the file to its scene. A file that has lost its entry point while being edited stays with its
/// scene. Other open scenes may include it and are marked, too.
std::string Session::take_up(const fs::path& file) {
    const auto scene = scene_of(file, documents_);
    const fs::path before = std::exchange(scenes_[file], scene.value_or(scenes_[file]));
    if (scenes_[file].empty())
        scenes_.erase(file);
    note_files(file);
    return before.empty() || !scene || *scene == before ? "" : leave(before);
}

/// Marks the scenes that read the file, or may now. Loads only those again, since hundreds may be open.
void Session::note_files(const fs::path& file) {
    for (const auto& [open, scene] : scenes_) {
        std::set<fs::path>& files = files_of_[scene];
        if (open == file || files.empty() || files.contains(file))
            files = files_of(scene, documents_);
        if (open == file || files.contains(file))
            stale_.insert(scene);
    }
}

/// Handles that a file of the scene was closed: if others are open, the scene is checked again with the text
/// on disk; else its diagnostics are removed.
std::string Session::leave(const fs::path& scene) {
    if (std::ranges::any_of(scenes_, [&](const auto& each) { return each.second == scene; })) {
        stale_.insert(scene);
        return "";
    }
    stale_.erase(scene);
    files_of_.erase(scene);
    return joined(board_.forget(scene, documents_));
}

std::string Session::conclude(const fs::path& scene, const Verdict& verdict) {
    const auto open = std::ranges::find_if(scenes_, [&](const auto& each) { return each.second == scene; });
    if (open == scenes_.end())
        return ""; // closed in the meantime
    return joined(board_.show(scene, open->first, verdict, documents_, encoding_));
}

} // namespace tidemark::lsp
