#include "core/design/written_out.hpp"

#include "core/error.hpp"

namespace irido {

namespace {

class Writer {
public:
    explicit Writer(WrittenOut& out) : out_(out) {}

    /// The places of the elements' layers in their order.
    std::vector<std::uint32_t> write(const std::vector<Element>& elements) {
        std::vector<std::uint32_t> order;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            place_.push_back(i);
            if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
                out_.place_of[place_] = out_.layers.size();
                order.push_back(static_cast<std::uint32_t>(out_.layers.size()));
                out_.layers.push_back(*layer);
            } else {
                const Group& group = std::get<Group>(elements[i].value);
                const std::vector<std::uint32_t> period = write(group.elements);
                require(group.repeat, period.size());
                require(1, order.size() + group.repeat * period.size());
                for (std::uint64_t n = 0; n < group.repeat; ++n)
                    order.insert(order.end(), period.begin(), period.end());
            }
            place_.pop_back();
        }
        return order;
    }

private:
    static void require(std::uint64_t repeat, std::size_t layers) {
        if (layers > 0 && repeat > WrittenOut::kMostLayers / layers)
            throw DomainError("must have at most 1e5 layers to be designed, repetitions included");
    }

    WrittenOut& out_;
    LayerPlace place_;
};

}  // namespace

WrittenOut::WrittenOut(const Stack& stack) {
    sequence = Writer(*this).write(stack.elements);
}

double total_thickness(const std::vector<Element>& elements) {
    double sum = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            sum += layer->thickness_nm;
        } else {
            const Group& group = std::get<Group>(element.value);
            sum += static_cast<double>(group.repeat) * total_thickness(group.elements);
        }
    }
    return sum;
}

Element* element_at(Stack& stack, const LayerPlace& place) {
    std::vector<Element>* elements = &stack.elements;
    Element* found = nullptr;
    for (const std::size_t i : place) {
        if (!elements || i >= elements->size()) return nullptr;
        found = &(*elements)[i];
        Group* const group = std::get_if<Group>(&found->value);
        elements = group ? &group->elements : nullptr;
    }
    return found;
}

}  // namespace irido
