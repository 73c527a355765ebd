#include "lab/fix/mend.hpp"

#include "base/try.hpp"
#include "lab/changed_scene.hpp"

#include <algorithm>
#include <map>
#include <memory>

namespace tidemark::lab {
namespace {

constexpr int k_most_rounds = 8;

class Mender {
public:
    Mender(const scene::Scene& scene, const Promises& promises, const Mending& mending)
        : scene_(scene), promises_(promises), mending_(mending),
          now_(std::make_unique<DrawnScene>(scene, promises)) {}

    Result<void> run() {
        TRY(now_->bench().compiled()); // a compile error is the result
        for (int round = 0; round < k_most_rounds; ++round) {
            refused_.clear();
            const CurableFindings found = TRY(find_curable(now_->bench(), mending_.hashes));
            if (!found.left_out.empty())
                refused_[found.left_out] = "nothing was looked at";
            if (!TRY(mend_all(found)))
                break;
        }
        for (const auto& [finding, why] : refused_)
            mending_.remains({finding, why});
        return {};
    }

private:
    /// Tries to fix all findings; returns whether any was fixed.
    Result<bool> mend_all(const CurableFindings& found) {
        bool mended = false;
        for (const Finding& finding : found.all) {
            if (finding.where && finding.kind == Finding::Kind::not_finite &&
                TRY(now_->fault(finding, found.views)) == 0)
                continue; // fixed by an earlier fix
            const auto offer = TRY(first_better(finding, found.views));
            if (!offer)
                continue;
            mended = true;
            mending_.offered(*offer, cures_);
        }
        return mended;
    }

    Result<std::optional<Offer>> first_better(const Finding& finding, const std::vector<PictureView>& views) {
        std::string& why = refused_[finding.sentence];
        why = finding.cures.empty() ? "no cure is known for it, or its words cannot be changed" : "";
        for (const glsl::Cure& cure : finding.cures) {
            cures_.push_back(cure);
            auto scene = changed(scene_, cures_);
            if (!scene || !mending_.can_be_written(cures_)) {
                why = cures_.size() > 1
                          ? "a cure before it changed its words: write that one, then look again"
                          : "its words are not found in a file of the scene";
            } else {
                auto next = std::make_unique<DrawnScene>(*std::move(scene), promises_);
                const auto judgement = judge(*now_, *next, finding, views);
                if (judgement && *judgement) {
                    refused_.erase(finding.sentence);
                    now_ = std::move(next);
                    return Offer{finding.sentence, **judgement};
                }
                why = judgement ? "no known cure makes it better without changing the rest"
                                : "the cured text is refused: " + to_string(judgement.error());
            }
            cures_.pop_back();
        }
        if (finding.only_a_warning)
            refused_.erase(finding.sentence);
        return std::optional<Offer>();
    }

    const scene::Scene& scene_;
    const Promises& promises_;
    const Mending& mending_;
    std::unique_ptr<DrawnScene> now_;
    std::vector<glsl::Cure> cures_{};
    std::map<std::string, std::string> refused_{};
};

} // namespace

Result<void> mend(const scene::Scene& scene, const Promises& promises, const Mending& mending) {
    return Mender(scene, promises, mending).run();
}

} // namespace tidemark::lab
