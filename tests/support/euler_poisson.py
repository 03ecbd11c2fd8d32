"""The scene of the Euler–Poisson sections with all its computations."""

from hess_explorer.protocol.specs import places
from hess_explorer.scenes import scenes
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from support.view import View

EP = scenes()["euler-poisson"]


class EulerPoisson(View):
    """View of this scene, with its body, energy and area constant."""

    def __init__(self, values, **options):
        super().__init__(EP, values, **options)
        self.body = self.result.body
        self.h, self.f = self.values["h"], self.values["f"]

    @property
    def start(self):
        """The state of the chosen orbit."""
        return AndoyerSection(self.body, self.h, self.f).state_at(*places(self.values["starts"])[-1])
