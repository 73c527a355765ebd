// The language server: what it answers, the diagnostics that it shows, and its state.
#pragma once

#include "editor/protocol.hpp"
#include "editor/workspace.hpp"

#include <tl/expected.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lsp {

// Requests of an editor about a place in a document, by the protocol's method names.

/// The reason why a request fails.
struct Refusal {
    ErrorNumber number;
    std::string message;
};
using Answer = tl::expected<Json, Refusal>;

tl::unexpected<Refusal> refuse(ErrorNumber number, std::string message);

/// A request. `workspace` is that of the document. All references must outlive it.
struct Question {
    const Workspace& workspace;
    const Json& params;
    const Documents& documents;
    Encoding encoding;

    /// Returns the offset of the position in the request.
    size_t offset() const;
};

using AnswerTo = Answer (*)(const Question&);
/// Returns nullptr for an unknown method. The returned function throws Json::exception where a parameter is
/// missing.
AnswerTo find_question(std::string_view method);

// The diagnostics of all open scenes, as notifications to the editor, which needs them by file.

/// The diagnostics of a scene. `hints` are neither errors nor warnings of a compiler.
struct Verdict {
    std::vector<Diagnostic> problems{};
    std::vector<Diagnostic> hints{};
};

class DiagnosticBoard {
public:
    /// Replaces the scene's diagnostics. Returns a notification for `main` and for each other file that has
    /// diagnostics now or had some before. Diagnostics without a file are listed in `main`.
    std::vector<Json> show(const std::filesystem::path& scene, const std::filesystem::path& main,
                           const Verdict& verdict, const Documents& documents, Encoding encoding);
    /// Removes a scene that is no longer open; returns notifications for its files.
    std::vector<Json> forget(const std::filesystem::path& scene, const Documents& documents);

private:
    using Files = std::map<std::filesystem::path, Json>;
    std::vector<Json> publish(const std::set<std::filesystem::path>& files, const Documents& documents) const;

    std::map<std::filesystem::path, Files> scenes_; ///< arrays of diagnostics, by scene and file
};

// The language server as a state machine: the editor's messages go in, messages for the editor and the scenes
// that need to be checked come out. Compiles nothing and waits for nothing.

class Session {
public:
    explicit Session(std::string version) : version_(std::move(version)) {}

    /// Handles the text of one message; returns the responses, framed.
    std::string receive(std::string_view text);

    /// Returns the scenes that changed since their last check began.
    const std::set<std::filesystem::path>& stale() const { return stale_; }
    /// Returns the number of text changes so far.
    int edits() const { return edits_; }
    /// Marks the scene as being checked with its current texts.
    void begin(const std::filesystem::path& scene) { stale_.erase(scene); }
    /// Takes the result of a check; returns framed notifications, or an empty text if the scene was closed.
    std::string conclude(const std::filesystem::path& scene, const Verdict& verdict);

    const Documents& documents() const { return documents_; }
    /// Returns the exit code of the process once `exit` was received.
    std::optional<int> exit_code() const { return exit_code_; }

private:
    std::string answer(const Json& message);
    Answer request(const std::string& method, const Json& params);
    Answer ask(const std::string& method, const Json& params) const;
    std::string notified(const std::string& method, const Json& params);

    Answer initialize(const Json& params);
    std::string open(const Json& params);
    std::string change(const Json& params);
    std::string close(const Json& params);
    void saved();
    std::string take_up(const std::filesystem::path& file);
    void note_files(const std::filesystem::path& file);
    std::string leave(const std::filesystem::path& scene);

    tl::expected<Workspace, Refusal> workspace_of(const Json& params) const;

    std::string version_;
    enum class Phase { fresh, running, shut_down } phase_ = Phase::fresh;
    Encoding encoding_ = Encoding::utf16;
    Documents documents_;
    DiagnosticBoard board_;
    std::map<std::filesystem::path, std::filesystem::path> scenes_; ///< scene of each open file that has one
    /// Files of each open scene as it was last loaded; empty: it does not load.
    std::map<std::filesystem::path, std::set<std::filesystem::path>> files_of_;
    std::set<std::filesystem::path> stale_;
    int edits_ = 0;
    std::optional<int> exit_code_;
};

} // namespace tidemark::lsp
