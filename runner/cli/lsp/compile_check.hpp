// Compiles a scene with the driver in a separate process and reports diagnostics. A driver that crashes or
// hangs, or a scene that exhausts memory, becomes a diagnostic, too.
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
    /// Starts the check with the texts that the editor holds. Call it while the process has no threads and no
    /// context (cli/forked.hpp).
    static Result<CompileCheck> start(const std::filesystem::path& scene, const lsp::Documents& documents,
                                      const platform::DeviceChoice& device, const ForkedLimits& limits);

    const std::filesystem::path& scene() const { return scene_; }
    int descriptor() const { return helper_.descriptor(); }

    /// Returns the verdicts that have arrived since the last call, each an extension of the one before. Never
    /// waits.
    std::vector<lsp::Verdict> look();
    bool ended() const { return ended_; }

private:
    CompileCheck(std::filesystem::path scene, ForkedHelper helper, ForkedLimits limits)
        : scene_(std::move(scene)), helper_(std::move(helper)), limits_(std::move(limits)) {}

    std::filesystem::path scene_;
    ForkedHelper helper_;
    ForkedLimits limits_;
    lsp::Verdict found_{};
    bool answered_ = false; ///< the problems have arrived
    bool ended_ = false;
};

} // namespace tidemark::cli
