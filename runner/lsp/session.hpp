// The language server as a state machine: messages of the editor go in, messages for it come out, and the
// scenes whose diagnostics are wanted. Compiles nothing, waits for nothing.
#pragma once

#include "lsp/diagnostic_board.hpp"
#include "lsp/questions.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lsp {

class Session {
public:
    explicit Session(std::string version) : version_(std::move(version)) {}

    /// The text of one message; gives the answers, framed.
    std::string receive(std::string_view text);

    /// Scenes that changed since their verdict was taken.
    const std::set<std::filesystem::path>& stale() const { return stale_; }
    /// How often a text has changed under the editor's hands.
    int edits() const { return edits_; }
    /// Somebody takes this one on, with the texts as they are now.
    void begin(const std::filesystem::path& scene) { stale_.erase(scene); }
    /// What was found; framed notifications.
    std::string conclude(const std::filesystem::path& scene, const Verdict& verdict);

    const Documents& documents() const { return documents_; }
    /// Set by `exit`: the code that the process ends with.
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
    std::map<std::filesystem::path, std::filesystem::path> scenes_; ///< of open files, where there is one
    /// Of each scene that is open: its files as they were loaded last; none: it does not load.
    std::map<std::filesystem::path, std::set<std::filesystem::path>> files_of_;
    std::set<std::filesystem::path> stale_;
    int edits_ = 0;
    std::optional<int> exit_code_;
};

} // namespace tidemark::lsp
