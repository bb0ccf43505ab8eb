#include "core/interference/spectrum.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/interference/vector/chain_program.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Points that one thread takes at a time.
constexpr std::size_t kPlainBlock = 64, kVectorBlock = 1024;

/// Fewer wavelengths than this go side by side with other angles.
constexpr std::size_t kFewWavelengths = 8;

/// The vector kernel's sine takes phases up to 2^40.
constexpr double kLargestPhase = 0x1p40;

/// Less work than this is not worth a second thread; its unit is about 0.1 us.
constexpr double kLittleWork = 1000, kPlainWork = 5, kVectorWork = 0.01;

/// Points that differ in their wavelength or in their angle only.
struct Job {
    bool along_angles;
    std::size_t fixed;  ///< index of the angle, or of the wavelength
    std::size_t begin, end;
};

/// Makes room for what is needed, keeping memory from before.
void allocate(Spectrum& spectrum, const Needs& needs, std::size_t points, std::size_t layers) {
    spectrum.R.resize(needs.R ? points : 0);
    spectrum.T.resize(needs.T ? points : 0);
    spectrum.A.resize(needs.A ? points : 0);
    spectrum.r.resize(needs.amplitudes ? points : 0);
    spectrum.t.resize(needs.amplitudes ? points : 0);
    spectrum.denominator.resize(needs.denominators ? points : 0);
    spectrum.log_scale.resize(needs.denominators ? points : 0);
    spectrum.A_layers.resize(needs.layers ? layers * points : 0);
}

void store(Spectrum& to, std::size_t point, const Response& response) {
    if (!to.R.empty()) to.R[point] = response.power.R;
    if (!to.T.empty()) to.T[point] = response.power.T;
    if (!to.A.empty()) to.A[point] = response.power.A;
    if (!to.r.empty()) {
        to.r[point] = response.r;
        to.t[point] = response.t;
    }
    if (!to.denominator.empty()) {
        to.denominator[point] = response.denominator;
        to.log_scale[point] = response.log_scale;
    }
}

void store_layers(Spectrum& to, std::size_t point, std::span<const double> absorbed) {
    if (absorbed.empty()) return;
    const std::size_t points = to.A_layers.size() / absorbed.size();
    for (std::size_t layer = 0; layer < absorbed.size(); ++layer)
        to.A_layers[layer * points + point] = absorbed[layer];
}

/// Points by the plain kernel.
class PlainRun {
public:
    PlainRun(const StackPower& stack, const IndexTable& table, const Needs& needs, Spectra& out)
        : stack_(stack),
          table_(table),
          needs_(needs),
          out_(out),
          media_(table.materials() + 1),
          absorbed_(needs.layers ? stack.layer_count() : 0) {}

    void operator()(double cos_theta, std::size_t wavelength, std::size_t point) {
        const double n0 = table_.n(table_.incident())[wavelength];
        for (std::size_t m = 0; m < table_.materials(); ++m)
            media_[m] = medium(table_.index(m, wavelength), n0, cos_theta);
        media_.back() = medium(n0, n0, cos_theta);
        const double k0 = table_.k0()[wavelength];
        Spectrum* const s = needs_.s ? &out_.s : nullptr;
        Spectrum* const p = needs_.p ? &out_.p : nullptr;
        if (cos_theta == 1) {
            compute(Polarization::s, k0, point, s, p);
        } else {
            if (s) compute(Polarization::s, k0, point, s, nullptr);
            if (p) compute(Polarization::p, k0, point, p, nullptr);
        }
    }

private:
    void compute(Polarization polarization, double k0, std::size_t point, Spectrum* to,
                 Spectrum* also) {
        Response response;
        try {
            response = stack_(media_, k0, polarization);
            if (needs_.layers) stack_.layer_absorption(media_, k0, polarization, absorbed_);
        } catch (const DomainError& error) {
            const double nm = table_.wavelength_nm()[point % table_.wavelength_nm().size()];
            throw DomainError(std::string(error.what()) + " (" + to_text(nm) + " nm, " +
                              (polarization == Polarization::s ? "s" : "p") + ")");
        }
        for (Spectrum* spectrum : {to, also}) {
            if (!spectrum) continue;
            store(*spectrum, point, response);
            if (needs_.layers) store_layers(*spectrum, point, absorbed_);
        }
    }

    const StackPower& stack_;
    const IndexTable& table_;
    const Needs& needs_;
    Spectra& out_;
    std::vector<Medium> media_;
    std::vector<double> absorbed_;
};

double* place(std::vector<double>& values, std::size_t point) {
    return values.empty() ? nullptr : values.data() + point;
}
Complex* place(std::vector<Complex>& values, std::size_t point) {
    return values.empty() ? nullptr : values.data() + point;
}

RunOutput output_at(Spectrum& spectrum, std::size_t point, std::size_t stride) {
    return {.R = place(spectrum.R, point),
            .T = place(spectrum.T, point),
            .A = place(spectrum.A, point),
            .r = place(spectrum.r, point),
            .t = place(spectrum.t, point),
            .denominator = place(spectrum.denominator, point),
            .log_scale = place(spectrum.log_scale, point),
            .stride = stride};
}

template <class T>
void copy_some(const std::vector<T>& from, std::vector<T>& to, std::size_t begin, std::size_t end) {
    if (!to.empty())
        std::copy(from.begin() + static_cast<std::ptrdiff_t>(begin),
                  from.begin() + static_cast<std::ptrdiff_t>(end),
                  to.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// Points [begin, end) of one polarization are those of the other.
void copy_points(const Spectrum& from, Spectrum& to, std::size_t begin, std::size_t end) {
    for (const auto values : {&Spectrum::R, &Spectrum::T, &Spectrum::A, &Spectrum::log_scale})
        copy_some(from.*values, to.*values, begin, end);
    for (const auto values : {&Spectrum::r, &Spectrum::t, &Spectrum::denominator})
        copy_some(from.*values, to.*values, begin, end);
}

/// Whether all points of an angle are better computed together: where both polarizations are one,
/// and where the incident wave carries no power.
bool is_special(double cos_theta) {
    return cos_theta == 1 || cos_theta == 0;
}

/// Points by the vector kernel, which leaves some to the plain one.
class VectorRun {
public:
    VectorRun(const ChainProgram& program, PlainRun& plain, const IndexTable& table,
              std::span<const double> cos_theta, const Needs& needs, SimdLevel simd, Spectra& out)
        : program_(program),
          plain_(plain),
          table_(table),
          cos_theta_(cos_theta),
          needs_(needs),
          simd_(simd),
          out_(out) {}

    void operator()(const Job& job) {
        const std::size_t wavelengths = table_.wavelength_nm().size();
        const bool across = job.along_angles;
        const std::size_t angle = across ? job.begin : job.fixed;
        const std::size_t wavelength = across ? job.fixed : job.begin;
        const std::size_t first = angle * wavelengths + wavelength;
        const std::size_t stride = across ? wavelengths : 1;
        const bool normal = !across && cos_theta_[angle] == 1;
        PointRun run{.count = job.end - job.begin,
                     .k0 = {table_.k0().data() + wavelength, !across},
                     .incident = stream(table_.n(table_.incident()), wavelength,
                                        !across && !table_.is_constant(table_.incident())),
                     .cos_theta = {cos_theta_.data() + angle, across},
                     .n = {},
                     .k = {},
                     .above = {}};
        std::vector<double> cosines;
        if (across) {
            cosines.assign(cos_theta_.begin() + static_cast<std::ptrdiff_t>(job.begin),
                           cos_theta_.begin() + static_cast<std::ptrdiff_t>(job.end));
            cosines.resize(cosines.size() + kMostLanes, 1);
            run.cos_theta.values = cosines.data();
        }
        for (std::size_t m = 0; m < table_.materials(); ++m) {
            const bool varies = !across && !table_.is_constant(m);
            run.n.push_back(stream(table_.n(m), wavelength, varies));
            run.k.push_back(stream(table_.k(m), wavelength, varies));
        }
        // at normal incidence s stands for p
        const bool only_p = normal && !needs_.s;
        const RunOutput s = output_at(only_p ? out_.p : out_.s, first, stride);
        const RunOutput p = output_at(out_.p, first, stride);
        redo_.clear();
        run_chain(program_, run, needs_.s || normal ? &s : nullptr,
                  needs_.p && !normal ? &p : nullptr, redo_, simd_);
        if (normal && needs_.s && needs_.p) copy_points(out_.s, out_.p, first, first + run.count);
        for (const std::size_t i : redo_)
            plain_(cos_theta_[across ? angle + i : angle], across ? wavelength : wavelength + i,
                   first + i * stride);
    }

private:
    static Stream stream(std::span<const double> row, std::size_t wavelength, bool varies) {
        return {row.data() + wavelength, varies};
    }

    const ChainProgram& program_;
    PlainRun& plain_;
    const IndexTable& table_;
    std::span<const double> cos_theta_;
    const Needs& needs_;
    SimdLevel simd_;
    Spectra& out_;
    std::vector<std::size_t> redo_;
};

/// The program of a stack that the vector kernel can take.
std::optional<ChainProgram> vector_program(const StackPower& stack, const IndexTable& table,
                                           const Needs& needs, SimdLevel simd) {
    const Chain* chain = stack.chain();
    if (!chain || needs.layers || simd == SimdLevel::plain) return std::nullopt;
    std::optional<ChainProgram> program = compile(*chain, table.absorbs(), table.amplifies());
    if (!program) return program;
    double largest_index = 0;
    for (std::size_t m = 0; m < table.materials(); ++m)
        for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w)
            largest_index =
                std::max(largest_index, std::abs(table.n(m)[w]) + std::abs(table.k(m)[w]));
    const double largest_k0 =
        *std::ranges::max_element(std::span(table.k0()).first(table.wavelength_nm().size()));
    for (const Program& block : program->down)
        if (block.largest_thickness_nm * largest_k0 * largest_index > kLargestPhase)
            return std::nullopt;
    return program;
}

/// Layers and periods' layers that one point takes.
std::size_t layers_of(const ChainProgram& program) {
    std::size_t layers = 0;
    for (const auto* direction : {&program.down, &program.up})
        for (const Program& block : *direction) layers += block.order.size();
    return layers;
}

void add_jobs(std::vector<Job>& jobs, Job whole, std::size_t block) {
    for (std::size_t begin = whole.begin; begin < whole.end; begin += block)
        jobs.push_back(
            {whole.along_angles, whole.fixed, begin, std::min(begin + block, whole.end)});
}

/// All points, in jobs that do not depend on the number of threads.
std::vector<Job> jobs_of(const IndexTable& table, std::span<const double> cos_theta,
                         bool by_vectors) {
    const std::size_t wavelengths = table.wavelength_nm().size(), angles = cos_theta.size();
    const std::size_t block = by_vectors ? kVectorBlock : kPlainBlock;
    const bool across = by_vectors && wavelengths < kFewWavelengths && angles > wavelengths;
    std::vector<Job> jobs;
    for (std::size_t a = 0; a < angles;) {
        if (!across || is_special(cos_theta[a])) {
            add_jobs(jobs, {false, a, 0, wavelengths}, block);
            ++a;
            continue;
        }
        const std::size_t begin = a;
        while (a < angles && !is_special(cos_theta[a])) ++a;
        for (std::size_t w = 0; w < wavelengths; ++w) add_jobs(jobs, {true, w, begin, a}, block);
    }
    return jobs;
}

}  // namespace

Work work_of(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
             const Needs& needs, const Execution& execution) {
    Work work{.points = cos_theta.size() * table.wavelength_nm().size()};
    work.normal_angles = static_cast<std::size_t>(std::ranges::count(cos_theta, 1.0));
    const std::optional<ChainProgram> program = vector_program(stack, table, needs, execution.simd);
    if (!program) return work;
    work.kernel = execution.simd;
    work.passes = program->down.size() + program->up.size();
    const bool incident_is_constant = table.is_constant(table.incident());
    std::set<std::size_t> media, constant_media;
    for (const Program& block : program->down) {
        work.layers += block.order.size();
        for (const std::uint32_t layer : block.order)
            if (!block.media[block.layers[layer].medium].absorbs) ++work.transparent_layers;
        work.distinct_layers += block.shares_layers ? block.layers.size() : block.order.size();
        work.powers += static_cast<std::size_t>(
            std::ranges::count(block.steps, Program::Kind::group, &Program::Step::kind));
        for (const Program::UsedMedium& medium : block.media) {
            media.insert(medium.material);
            if (incident_is_constant && table.is_constant(medium.material))
                constant_media.insert(medium.material);
        }
        work.absorbs |= block.absorbs;
    }
    work.media = media.size();
    work.constant_media = constant_media.size();
    const bool constant = work.constant_media == work.media;
    work.one_film = work.passes == 1 && program->down[0].is_one_film();
    const bool both = needs.s && needs.p && work.normal_angles < cos_theta.size();
    for (const auto* direction : {&program->down, &program->up})
        for (const Program& block : *direction)
            work.operations_per_point += operations_per_point(block, both ? 2 : 1, constant);
    return work;
}

Spectra spectra(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
                const Needs& needs, const Execution& execution) {
    Spectra out;
    spectra(stack, table, cos_theta, needs, execution, out);
    return out;
}

void spectra(const StackPower& stack, const IndexTable& table, std::span<const double> cos_theta,
             const Needs& needs, const Execution& execution, Spectra& out) {
    const std::size_t wavelengths = table.wavelength_nm().size();
    const std::size_t points = cos_theta.size() * wavelengths;
    if (needs.amplitudes && !stack.has_amplitudes())
        throw DomainError("amplitudes exist for coherent layers of fixed thicknesses only");
    const std::size_t layers = needs.layers ? stack.layer_count() : 0;
    allocate(out.s, needs, needs.s ? points : 0, layers);
    allocate(out.p, needs, needs.p ? points : 0, layers);
    if (points == 0) return;
    const std::optional<ChainProgram> program = vector_program(stack, table, needs, execution.simd);
    const std::vector<Job> jobs = jobs_of(table, cos_theta, program.has_value());
    const double work =
        static_cast<double>(points) *
        (program ? kVectorWork * static_cast<double>(layers_of(*program) + 2) : kPlainWork);
    parallel_for(jobs.size(), work < kLittleWork ? 1 : execution.threads, [&](std::size_t j) {
        PlainRun plain(stack, table, needs, out);
        const Job& job = jobs[j];
        const bool grazing = !job.along_angles && cos_theta[job.fixed] == 0;
        if (program && !grazing)
            return VectorRun(*program, plain, table, cos_theta, needs, execution.simd, out)(job);
        for (std::size_t w = job.begin; w < job.end; ++w)
            plain(cos_theta[job.fixed], w, job.fixed * wavelengths + w);
    });
}

}  // namespace irido
