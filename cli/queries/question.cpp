#include "cli/queries/question.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/queries/bands_question.hpp"
#include "cli/queries/cm_question.hpp"
#include "cli/queries/color_question.hpp"
#include "cli/queries/spectrum_question.hpp"

namespace irido {

nlohmann::json Question::data() const {
    return nullptr;
}

void note_incident(const StackDocument& document, const IndexTable& table,
                   const std::function<void(const std::string&)>& say) {
    if (is_constant(document.stack.materials[document.stack.incident])) return;  // said when read
    double largest = 0;
    for (const double k : table.k(table.incident())) largest = std::max(largest, std::abs(k));
    if (largest > 0) say(document.file + ": /incident: " + incident_note(largest));
}

Records records_of(const Question& question, const PreparedStack& prepared) {
    const std::unique_ptr<Answers> answers = question.answers();
    answers->add(prepared, prepared.document.stack, {question.angles_deg()});
    return answers->records();
}

std::span<const QuestionKind> question_kinds() {
    static constexpr std::array kinds{
        QuestionKind{"spectrum", SpectrumOptions::add},
        QuestionKind{"color", ColorQuestionOptions::add},
        QuestionKind{"bands", BandsOptions::add},
        QuestionKind{"cm", CmOptions::add},
    };
    return kinds;
}

}  // namespace irido
