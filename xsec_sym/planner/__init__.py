"""From a scene's needs to the cheapest kernels that meet them: measured, chosen, written as one module, and checked."""

from xsec_sym.planner.planning import Plan, PlannedMaterial, Unmet, plan
from xsec_sym.planner.scene import BadScene, Material, Scene

__all__ = ["BadScene", "Material", "Plan", "PlannedMaterial", "Scene", "Unmet", "plan"]
