#include "schemas/documents/rough_faces.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

/// An upper face; `cut` is the thickness that it takes from the layers on either side.
struct RoughFace {
    double rough_nm = 0, cut_nm = 0;
    bool centred = false;
};

/// The elements of one array of the document.
struct WrittenElements {
    const json& array;
    const std::vector<Element>& elements;
    std::string pointer;

    std::string place(std::size_t i) const { return pointer + "/" + std::to_string(i); }
    const Group* group(std::size_t i) const {
        return array[i].contains("layers") ? &std::get<Group>(elements[i].value) : nullptr;
    }
    WrittenElements inside(std::size_t i) const {
        return {array[i]["layers"], group(i)->elements, place(i) + "/layers"};
    }
};

class RoughFaces {
public:
    RoughFaces(const json& document, const FaceReader& reader)
        : reader_(reader), placement_(document.value("roughness_placement", "added")) {}

    RoughFace face(const json& object, const char* key) const {
        const double rough_nm = object.value(key, 0.0);
        const bool centred = object.value("roughness_placement", placement_) == "centred";
        return {rough_nm, centred ? rough_nm / 2 : 0, centred};
    }

    /// The elements with their interface layers, given the material above them and the face below
    /// the last one.
    std::vector<Element> expanded(const WrittenElements& from, std::size_t above,
                                  const RoughFace& last) {
        std::vector<Element> result;
        for (std::size_t i = 0; i < from.array.size(); ++i) {
            const bool is_last = i + 1 == from.array.size();
            const RoughFace below = is_last ? last : first_face(from.array[i + 1]);
            result.push_back(from.group(i) ? group(from, i, above, below)
                                           : layer(from, i, above, below));
            above = end(from, i, false);
        }
        return result;
    }

    Element between(std::size_t above, std::size_t below, const RoughFace& face,
                    const std::string& pointer) const {
        Layer mixed;
        mixed.material = reader_.between(above, below, face.centred, pointer);
        mixed.thickness_nm = face.rough_nm;
        return {mixed};
    }

    /// The material at the top or bottom of an element.
    std::size_t end(const WrittenElements& from, std::size_t i, bool top) const {
        if (from.group(i)) {
            const WrittenElements inside = from.inside(i);
            return end(inside, top ? 0 : inside.array.size() - 1, top);
        }
        const auto* layer = std::get_if<Layer>(&from.elements[i].value);
        return layer ? layer->material : reader_.end_of(from.array[i], from.place(i), top);
    }

private:
    RoughFace first_face(const json& object) const {
        return object.contains("layers") ? first_face(object["layers"][0])
                                         : face(object, "roughness_nm");
    }

    static bool is_rough(const json& array) {
        return std::ranges::any_of(array, [](const json& object) {
            return object.contains("layers") ? is_rough(object["layers"])
                                             : object.value("roughness_nm", 0.0) > 0;
        });
    }

    Element layer(const WrittenElements& from, std::size_t i, std::size_t above,
                  const RoughFace& below) {
        const Element& element = from.elements[i];
        const RoughFace own = face(from.array[i], "roughness_nm");
        const double cut_nm = own.cut_nm + below.cut_nm;
        if (own.rough_nm == 0 && cut_nm == 0) return element;
        Group parts;
        if (own.rough_nm > 0)
            parts.elements.push_back(
                between(above, end(from, i, true), own, from.place(i) + "/roughness_nm"));
        parts.elements.push_back(element);
        if (cut_nm > 0) cut(parts.elements.back(), cut_nm, from.place(i));
        return {std::move(parts)};
    }

    void cut(Element& element, double cut_nm, const std::string& pointer) const {
        auto* layer = std::get_if<Layer>(&element.value);
        if (!layer) {
            reader_.report(pointer,
                           "a graded layer cannot lose thickness to centred roughness; "
                           "use \"roughness_placement\": \"added\"");
        } else if (layer->thickness_nm < cut_nm) {
            reader_.report(pointer, "must be as thick as centred roughness takes from it, " +
                                        to_text(cut_nm) + " nm (got " +
                                        to_text(layer->thickness_nm) + ")");
        } else {
            layer->thickness_nm -= cut_nm;
        }
    }

    Element group(const WrittenElements& from, std::size_t i, std::size_t above,
                  const RoughFace& below) {
        const Group& group = *from.group(i);
        const WrittenElements inside = from.inside(i);
        if (!is_rough(inside.array) && below.cut_nm == 0) return {group};
        const RoughFace first = first_face(inside.array[0]);
        const std::size_t before = end(from, i, false);
        Group all;
        const auto add = [&](std::uint64_t repeat, std::size_t medium, const RoughFace& face) {
            if (repeat > 0) all.elements.push_back({Group{repeat, expanded(inside, medium, face)}});
        };
        const std::uint64_t n = group.repeat;
        const bool first_differs = first.rough_nm > 0 && before != above;
        const bool last_differs = first.cut_nm != below.cut_nm;
        if (n == 1) {
            add(1, above, below);
        } else if (first_differs) {
            add(1, above, first);
            add(last_differs ? n - 2 : n - 1, before, first);
            if (last_differs) add(1, before, below);
        } else {
            add(last_differs ? n - 1 : n, before, first);
            if (last_differs) add(1, before, below);
        }
        if (all.elements.size() == 1) return std::move(all.elements[0]);
        return {std::move(all)};
    }

    const FaceReader& reader_;
    std::string placement_;
};

}  // namespace

std::vector<Element> with_rough_faces(const json& document, const std::vector<Element>& elements,
                                      std::size_t incident, std::size_t substrate,
                                      const FaceReader& reader) {
    RoughFaces faces(document, reader);
    const RoughFace last = faces.face(document, "substrate_roughness_nm");
    const WrittenElements whole{document["layers"], elements, "/layers"};
    std::vector<Element> result = faces.expanded(whole, incident, last);
    if (last.rough_nm > 0) {
        const std::size_t above =
            elements.empty() ? incident : faces.end(whole, elements.size() - 1, false);
        result.push_back(faces.between(above, substrate, last, "/substrate_roughness_nm"));
    }
    return result;
}

bool has_rough_faces(const json& document) {
    const auto is_rough = [](const json& value, const auto& self) -> bool {
        if (!value.is_object()) return false;
        for (const char* key : {"roughness_nm", "substrate_roughness_nm"})
            if (value.contains(key) && value[key].is_number() && value[key] > 0) return true;
        const auto layers = value.find("layers");
        return layers != value.end() && layers->is_array() &&
               std::ranges::any_of(*layers,
                                   [&](const json& element) { return self(element, self); });
    };
    return is_rough(document, is_rough);
}

}  // namespace irido::schemas
