// The language server: what it answers, the diagnostics that it shows, and its state.
#pragma once

#include "editor/protocol.hpp"
#include "editor/workspace.hpp"
#include "shader/builtin_functions.hpp"

#include <tl/expected.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

Answer signature_help(const Question& asked);
// The answers that have files of their own. completion.cpp:
Answer completions(const Question& asked);
/// Adds the description to a completion of a built-in function or a uniform of the host.
Json resolved_completion(Json item);
// names.cpp:
Answer references(const Question& asked);
Answer highlights(const Question& asked);
Answer renamed_range(const Question& asked);
Answer rename(const Question& asked);
// tokens.cpp:
Answer semantic_tokens(const Question& asked);
Answer folding_ranges(const Question& asked);
Answer code_actions(const Question& asked);

/// A fix of a scene's texts that was drawn and measured, on top of those before it.
struct MeasuredFix {
    std::string title;  ///< what it changes
    std::string report; ///< the finding, then the measurements
    /// The texts with the earlier fixes, and with this one.
    struct File {
        std::filesystem::path name;
        std::string before, after;
    };
    std::vector<File> files;
};
/// Returns the CodeActions of the fixes that change a line in the request's range and need no earlier one,
/// and one that applies all. The documents must hold the texts that were measured. `versioned`: the editor
/// takes edits of a version of a document.
Json fix_actions(const Question& asked, const std::vector<MeasuredFix>& fixes, bool versioned);
/// Returns a hint at each place that such an action changes.
std::vector<Diagnostic> fix_hints(const std::vector<MeasuredFix>& fixes, const Documents& documents);

/// The names of the types and modifiers of semantic tokens.
Json semantic_legend();

/// Return Markdown, empty for an unknown name: of a built-in function, and of a uniform of the host.
std::string describe_builtin(std::string_view name);
std::string describe_host(std::string_view name);
/// Returns `float smoothstep(float, float, float)`.
std::string signature(const glsl::BuiltinFunction& function, const glsl::BuiltinOverload& overload);

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
    enum class From { compiler, measurement };

    /// Replaces the scene's diagnostics from there. Returns a notification for `main` and for each other file
    /// that has diagnostics now or had some before. Diagnostics without a file are listed in `main`.
    std::vector<Json> show(From from, const std::filesystem::path& scene, const std::filesystem::path& main,
                           const Verdict& verdict, const Documents& documents, Encoding encoding);
    /// Removes the scene's diagnostics from there; returns notifications for its files.
    std::vector<Json> forget(From from, const std::filesystem::path& scene, const Documents& documents);

private:
    using Files = std::map<std::filesystem::path, Json>;
    std::vector<Json> publish(const std::set<std::filesystem::path>& files, const Documents& documents) const;

    std::map<std::pair<std::filesystem::path, From>, Files> scenes_; ///< arrays of diagnostics by file
};

/// A command of the editor whose response needs another process: it is carried out by the owner of the
/// session, which then sends the response itself.
struct Order {
    enum class Kind { open_preview, open_window, close_preview };
    Kind kind;
    Json id; ///< of the request
    std::filesystem::path scene;
    std::vector<std::string> ancestors; ///< pages that may frame the preview
    std::vector<std::string> origins;   ///< of addresses that the preview's is forwarded to
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
    /// Returns the number of times so far that `documents` changed.
    int revisions() const { return revisions_; }
    /// Returns the commands received since the last call.
    std::vector<Order> take_orders() { return std::exchange(orders_, {}); }
    /// Marks the scene as being checked with its current texts.
    void begin(const std::filesystem::path& scene) { stale_.erase(scene); }
    /// Takes the result of a check; returns framed notifications, or an empty text if the scene was closed.
    std::string conclude(const std::filesystem::path& scene, const Verdict& verdict);

    /// Returns the scene that was opened or edited last, if it compiles and was not measured with its present
    /// texts.
    std::optional<std::filesystem::path> unmeasured() const;
    /// Marks the scene as being measured with its present texts, until one of them changes.
    void begin_measuring(const std::filesystem::path& scene);
    /// Returns whether the scene still has the texts that are being measured.
    bool is_measured(const std::filesystem::path& scene) const { return measured_.contains(scene); }
    /// Take what was measured; return framed notifications. `error` has the members of
    /// `$/tidemark/measured` beside the scene.
    std::string show_error(const std::filesystem::path& scene, Json error) const;
    std::string show_fix(const std::filesystem::path& scene, MeasuredFix fix);

    const Documents& documents() const { return documents_; }
    /// Returns the exit code of the process once `exit` was received.
    std::optional<int> exit_code() const { return exit_code_; }

private:
    std::string answer(const Json& message);
    Answer request(const std::string& method, const Json& params);
    std::string command(const Json& id, const Json& params);
    Answer ask(const std::string& method, const Json& params) const;
    std::string notified(const std::string& method, const Json& params);

    Answer initialize(const Json& params);
    std::string open(const Json& params);
    std::string change(const Json& params);
    std::string close(const Json& params);
    void saved();
    std::string take_up(const std::filesystem::path& file);
    std::map<std::filesystem::path, std::string> texts_of_scene(const std::filesystem::path& scene) const;
    std::string drop_outdated();
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
    std::filesystem::path recent_; ///< scene of the document that was opened or edited last; may be empty
    bool recent_compiles_ = false;
    /// The fixes of a scene that had these texts.
    struct Measured {
        std::map<std::filesystem::path, std::string> texts;
        std::vector<MeasuredFix> fixes{};
    };
    std::map<std::filesystem::path, Measured> measured_;
    bool versioned_edits_ = false; ///< the editor takes edits of a version of a document
    std::vector<Order> orders_;
    int edits_ = 0;
    int revisions_ = 0;
    std::optional<int> exit_code_;
};

} // namespace tidemark::lsp
