// What is wrong with a scene, found by the driver that draws it, in a process of its own: neither a driver
// that crashes or hangs nor a text that takes all memory is more than a diagnostic.
#pragma once

#include "base/result.hpp"
#include "cli/forked.hpp"
#include "lsp/diagnostic_board.hpp"
#include "platform/device_choice.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace tidemark::cli {

class CompileCheck {
public:
    /// Of the scene as the editor holds its files. To be called without threads or a context
    /// (cli/forked.hpp).
    static Result<CompileCheck> start(const std::filesystem::path& scene, const lsp::Documents& documents,
                                      const platform::DeviceChoice& device, const ForkedLimits& limits);

    const std::filesystem::path& scene() const { return scene_; }
    int descriptor() const { return helper_.descriptor(); }

    /// The verdicts that came by now, each more than the one before; none where nothing is new.
    std::vector<lsp::Verdict> look();
    bool ended() const { return ended_; }

private:
    CompileCheck(std::filesystem::path scene, ForkedHelper helper, ForkedLimits limits)
        : scene_(std::move(scene)), helper_(std::move(helper)), limits_(std::move(limits)) {}

    std::filesystem::path scene_;
    ForkedHelper helper_;
    ForkedLimits limits_;
    lsp::Verdict found_{};
    bool answered_ = false; ///< the problems are known
    bool ended_ = false;
};

} // namespace tidemark::cli
