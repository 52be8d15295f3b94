// A beam of Project Chrono is led by Eq. 1: driver KIND N h EVERY L EA EI m R omega T end mass g
//
// KIND is cable (ChElementCableANCF), timoshenko (ChElementBeamTaperedTimoshenko) or iga
// (ChElementBeamIGA, cubic). The beam lies along x and turns about z. Every so many steps a line has
// time and place of the tip, x and y, by axes that do not turn.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "chrono/fea/ChBuilderBeam.h"
#include "chrono/fea/ChLinkNodeFrame.h"
#include "chrono/fea/ChLinkNodeSlopeFrame.h"
#include "chrono/fea/ChMesh.h"
#include "chrono/functions/ChFunction.h"
#include "chrono/physics/ChBody.h"
#include "chrono/physics/ChLinkMate.h"
#include "chrono/physics/ChLinkMotorRotationAngle.h"
#include "chrono/physics/ChSystemSMC.h"
#include "chrono/solver/ChDirectSolverLS.h"
#include "chrono/timestepper/ChTimestepperHHT.h"

using namespace chrono;
using namespace chrono::fea;
using std::make_shared;
using std::shared_ptr;

static const double SHEAR = 1.0;     // GA over EA: nearly Bernoulli and Euler's beam
static const double TURNING = 1e-2;  // rotary inertia over m EI/EA
static const double ALPHA = -0.05;   // of HHT

struct Spin : ChFunction {
    double omega, T;
    Spin(double omega, double T) : omega(omega), T(T) {}
    Spin* Clone() const override { return new Spin(*this); }
    double GetVal(double t) const override {
        const double turn = 2.0 * CH_PI / T;
        if (t >= T) return omega * (t - 0.5 * T);
        return omega / T * (0.5 * t * t + (std::cos(turn * t) - 1.0) / (turn * turn));
    }
    double GetDer(double t) const override {
        const double turn = 2.0 * CH_PI / T;
        return t >= T ? omega : omega / T * (t - std::sin(turn * t) / turn);
    }
    double GetDer2(double t) const override {
        return t >= T ? 0.0 : omega / T * (1.0 - std::cos(2.0 * CH_PI / T * t));
    }
};

int main(int count, char** words) {
    if (count != 15) {
        std::fprintf(stderr, "driver KIND N h EVERY L EA EI m R omega T end mass g\n");
        return 2;
    }
    const std::string kind = words[1];
    auto number = [&](int k) { return std::atof(words[k]); };
    const int N = std::atoi(words[2]), every = std::atoi(words[4]);
    const double h = number(3), L = number(5), EA = number(6), EI = number(7), m = number(8);
    const double R = number(9), end = number(12), mass = number(13), g = number(14);

    ChSystemSMC system;
    system.SetGravitationalAcceleration(ChVector3d(0, -g, 0));
    auto ground = make_shared<ChBody>(), hub = make_shared<ChBody>();
    ground->SetFixed(true);
    hub->SetMass(m * L);
    hub->SetInertiaXX(ChVector3d(1, 1, 1) * (m * L * L * L));
    system.AddBody(ground);
    system.AddBody(hub);
    auto motor = make_shared<ChLinkMotorRotationAngle>();
    motor->Initialize(hub, ground, ChFrame<>());
    motor->SetAngleFunction(make_shared<Spin>(number(10), number(11)));
    system.AddLink(motor);

    auto mesh = make_shared<ChMesh>();
    mesh->SetAutomaticGravity(g != 0.0, 2);
    const ChVector3d root(R, 0, 0), far(R + L, 0, 0);
    shared_ptr<ChNodeFEAxyz> point;
    shared_ptr<ChNodeFEAxyzrot> frame;
    if (kind == "cable") {
        auto section = make_shared<ChBeamSectionCableANCF>();
        section->SetArea(1.0);
        section->SetYoungModulus(EA);
        section->SetInertia(EI / EA);
        section->SetDensity(m);
        section->SetRayleighDamping(0.0);
        ChBuilderCableANCF builder;
        builder.BuildBeam(mesh, section, N, root, far);
        auto first = builder.GetLastBeamNodes().front();
        point = builder.GetLastBeamNodes().back();
        auto held = make_shared<ChLinkNodeFrame>();
        held->Initialize(first, hub);
        system.AddLink(held);
        auto led = make_shared<ChLinkNodeSlopeFrame>();
        led->Initialize(first, hub);
        system.AddLink(led);
        if (mass > 0.0) point->SetMass(mass);
    } else {
        shared_ptr<ChNodeFEAxyzrot> first;
        const double J = TURNING * m * EI / EA;
        if (kind == "timoshenko") {
            DampingCoefficients none;
            none.bx = none.by = none.bz = none.bt = none.alpha = 0.0;
            auto section = make_shared<ChBeamSectionTimoshenkoAdvancedGeneric>(
                EA, EI, EI, EI, SHEAR * EA, SHEAR * EA, none, 0, 0, 0, 0, 0, m, J, J);
            auto tapered = make_shared<ChBeamSectionTaperedTimoshenkoAdvancedGeneric>();
            tapered->SetSectionA(section);
            tapered->SetSectionB(section);
            ChBuilderBeamTaperedTimoshenko builder;
            builder.BuildBeam(mesh, tapered, N, root, far, VECT_Y);
            first = builder.GetLastBeamNodes().front();
            frame = builder.GetLastBeamNodes().back();
        } else if (kind == "iga") {
            auto inertia = make_shared<ChInertiaCosseratSimple>(m, 1.0, J / m, J / m);
            auto elasticity = make_shared<ChElasticityCosseratAdvancedGeneric>(
                EA, EI, EI, EI, SHEAR * EA, SHEAR * EA, 0, 0, 0, 0, 0, 0);
            auto section = make_shared<ChBeamSectionCosserat>(inertia, elasticity);
            ChBuilderBeamIGA builder;
            builder.BuildBeam(mesh, section, N, root, far, VECT_Y, 3);
            first = builder.GetLastBeamNodes().front();
            frame = builder.GetLastBeamNodes().back();
        } else {
            std::fprintf(stderr, "KIND must be cable, timoshenko or iga, got %s\n", kind.c_str());
            return 2;
        }
        auto held = make_shared<ChLinkMateFix>();
        held->Initialize(first, hub);
        system.AddLink(held);
        if (mass > 0.0) frame->SetMass(mass);
    }
    system.Add(mesh);

    auto solver = make_shared<ChSolverSparseLU>();
    solver->UseSparsityPatternLearner(true);
    solver->LockSparsityPattern(true);
    system.SetSolver(solver);
    auto stepper = make_shared<ChTimestepperHHT>(&system);
    stepper->SetAlpha(ALPHA);
    stepper->SetStepControl(false);
    stepper->SetMaxIters(30);
    stepper->SetAbsTolerances(1e-9, 1e-6);
    stepper->SetRelTolerance(1e-9);
    system.SetTimestepper(stepper);

    const int steps = static_cast<int>(std::lround(end / h));
    for (int k = 0; k <= steps; ++k) {
        if (k) system.DoStepDynamics(h);
        if (k % every) continue;
        const ChVector3d at = point ? point->GetPos() : frame->GetPos();
        if (!std::isfinite(at.x())) {
            std::fprintf(stderr, "no place of the tip at %g s\n", k * h);
            return 1;
        }
        std::printf("%.9g %.15g %.15g\n", k * h, at.x(), at.y());
    }
    return 0;
}
