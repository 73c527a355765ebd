// The previews of the language server: windows and browser pages that draw the texts of the editor. Each is a
// process of this program, which ends with the server.
#pragma once

#include "base/process.hpp"
#include "editor/session.hpp"

#include <poll.h>

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

class Previews {
public:
    using Clock = std::chrono::steady_clock;

    /// `options` are given to each process, as in `--memory 2G`.
    explicit Previews(std::vector<std::string> options) : options_(std::move(options)) {}
    Previews(const Previews&) = delete;
    Previews& operator=(const Previews&) = delete;
    /// Asks all processes to end, and kills those that do not within a second.
    ~Previews();

    /// Carries out a command with the texts that the editor holds. Returns its response, framed; an empty
    /// text if the response comes from `look` later.
    std::string obey(const lsp::Order& order, const scene::UnsavedTexts& texts);
    /// Sends the texts that have changed. Never waits.
    void send(const scene::UnsavedTexts& texts);
    /// Has the previews of a scene, also later ones, show some words in their titles, until it is called
    /// again. Never waits.
    void note(const std::filesystem::path& scene, const std::string& words);
    /// Reads what the processes print. Returns messages for the editor, framed. Never waits.
    std::string look();

    /// Adds the descriptors after which `look` has something to do.
    void add_to(std::vector<pollfd>& waits) const;
    /// Returns whether `look` must be called now and then although nothing arrives.
    bool waits() const;

private:
    struct Preview {
        lsp::Order::Kind kind;
        std::filesystem::path scene;
        std::vector<std::string> ancestors;
        std::vector<std::string> origins;
        ChildProcess process;
        Clock::time_point begun = Clock::now();
        scene::UnsavedTexts sent{};                ///< texts that it has
        std::optional<scene::UnsavedTexts> next{}; ///< newer texts, sent after `unsent`
        std::optional<std::string> next_note{};    ///< sent after `unsent`
        std::string unsent{};                      ///< the rest of a line
        std::string printed{};                     ///< on standard output, up to the address
        std::string words{};                       ///< on standard error, without whole lines
        std::string last_words{};                  ///< the last line on standard error
        std::optional<lsp::Json> address{};        ///< the response to open_preview
        std::vector<lsp::Json> waiting{};          ///< ids of requests that wait for the address

        std::string name() const { return scene.filename().string(); }
    };

    Preview* find(lsp::Order::Kind kind, const std::filesystem::path& scene);
    std::string start(const lsp::Order& order, const scene::UnsavedTexts& texts, int port = 0);
    static void push(Preview& preview);
    static std::string hear(Preview& preview);
    static std::string end(Preview& preview);

    std::vector<std::string> options_;
    std::deque<Preview> previews_;
    std::map<std::filesystem::path, std::string> notes_; ///< words in titles, by scene
};

} // namespace tidemark::cli
