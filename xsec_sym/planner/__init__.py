"""From a scene's needs to the cheapest kernels that meet them: measured, chosen, written as one module, and checked."""





