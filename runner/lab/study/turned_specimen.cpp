#include "lab/study/turned_specimen.hpp"

#include "base/try.hpp"

namespace tidemark::lab {

Result<Specimen*> TurnedSpecimen::at(const std::vector<Setting>& settings, glsl::Precision precision) {
    if (precision != precision_)
        turnable_.reset();
    precision_ = precision;
    if (const auto knobs = turnable_ ? turnable_->knobs_at(settings) : std::nullopt) {
        specimen_->turn(*knobs);
        return &*specimen_;
    }
    if (own_text_only_ || !make_turnable(settings)) {
        turnable_.reset();
        specimen_ = TRY(Specimen::create(scene_, {settings, precision_}, extent_, hits_));
        own_text_only_ = true;
    }
    return &*specimen_;
}

bool TurnedSpecimen::make_turnable(const std::vector<Setting>& settings) {
    auto turnable = TurnableScene::create(scene_, settings);
    if (!turnable || !turnable->knobs_at(settings))
        return false;
    auto specimen = Specimen::create(turnable->scene(), {{}, precision_}, extent_, hits_);
    if (!specimen)
        return false;
    turnable_ = *std::move(turnable);
    specimen_ = *std::move(specimen);
    return true;
}

} // namespace tidemark::lab
