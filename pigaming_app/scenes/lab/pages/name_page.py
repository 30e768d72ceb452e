"""Name entry for the robot."""

from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.scenes.lab.host import IDLE, LabHost
from pigaming_app.scenes.lab.saved_robots import LENGTH, RobotFileError, names, proposal
from pigaming_app.scenes.pages import name_page


class RobotNamePage(name_page.NamePage):
    """Prompts for a name and saves the robot under it."""

    def __init__(self, lab: LabHost) -> None:
        super().__init__(lab.context, "lab.name_title", lab.name or proposal(), LENGTH, IDLE)
        self.lab = lab

    def is_taken(self, name: str) -> bool:
        return name != self.lab.name and name in names()

    def keep(self, name: str) -> StackOperation:
        words = self.context.words
        try:
            self.lab.trainer.save(name)
            self.lab.name = name
            self.lab.show_message(words("lab.saved", name=name))
        except RobotFileError as error:
            self.lab.show_message(words(str(error)), wrong=True)
        return Pop()
