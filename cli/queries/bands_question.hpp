#pragma once

#include <string>
#include <vector>

#include "cli/queries/question.hpp"
#include "core/periodic/bragg_mirror.hpp"

namespace irido::cli {

/// What irido bands is asked, as typed.
struct BandsOptions : QuestionOptions {
    std::string angles = "0";
    std::string polarization = "s,p";
    std::string range = "360:830";
    bool gaps = false;

    static std::unique_ptr<QuestionOptions> add(CLI::App& command);
    std::unique_ptr<const Question> parse(const Answering& answering) const override;
    nlohmann::json typed() const override;
};

/// Landmarks or gaps of a Bragg mirror.
class BandsQuestion : public Question {
public:
    BandsQuestion(const BandsOptions& typed, const Answering& answering);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    bool splits_angles() const override { return !gaps_; }  // what all angles say of a gap
    std::size_t rows_per_angle() const override { return 0; }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<Answers> answers() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;

    double first_nm() const { return first_nm_; }
    double last_nm() const { return last_nm_; }
    /// A little wider than asked, against the roundings of 2 pi / wavelength.
    OmegaRange omega() const;
    /// The mirror that a stack is. Throws InputError.
    BraggMirror mirror(const schemas::StackDocument& document, const Stack& stack) const;

private:
    friend class LandmarkAnswers;
    friend class GapAnswers;

    std::vector<double> angles_deg_;
    std::vector<Polarization> polarizations_;
    double first_nm_ = 0, last_nm_ = 0;
    bool gaps_ = false;
    Answering answering_;
};

}  // namespace irido::cli
