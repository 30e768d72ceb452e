"""The course of a training as a picture, which is renewed while it runs: wins, and what each update did."""

from dataclasses import astuple
from typing import Any

from pigaming_app.ai.ppo.training import scores_at
from pigaming_app.jobs.learning.train.outputs import png_of, with_plots
from pigaming_app.jobs.learning.train.telemetry import TrainingTable

WINS, RATING = "share of wins", "rating of copies"
PLOTS = {  # a column of the table, by the title of its plot
    "return of the decisions": "mean_return",
    "entropy of the policy, nats": "entropy",
    "decisions a second": "decisions_per_second",
    "KL divergence": "kl",
    "clipped share": "clipped",
    "loss of the value function": "value_loss",
    "explained variance": "explained",
}
PLACES = (
    (WINS, WINS, *list(PLOTS)[:1]),
    (WINS, WINS, *list(PLOTS)[1:2]),
    tuple(PLOTS)[2:5],
    (*tuple(PLOTS)[5:], RATING),
)


def page_of(table: TrainingTable) -> bytes:
    """The page as a PNG file."""
    training = table.training
    figure, plots = with_plots(PLACES)
    _draw_wins(plots[WINS], table)
    for title, column in PLOTS.items():
        for prefix in table.prefixes:
            if points := table.points(f"{prefix}{column}"):
                millions, values = zip(*points, strict=True)
                plots[title].plot(millions, values, label=prefix.rstrip("_") or "network", linewidth=1.0)
        plots[title].set_title(title, fontsize="medium")
    if len(table.prefixes) > 1:
        plots["entropy of the policy, nats"].legend(fontsize="small")
    _draw_ratings(plots[RATING], table)
    figure.suptitle(f"{training.task.game}, seed {training.seed}, {training.updates} updates")
    figure.supxlabel("decisions, millions", fontsize="medium")
    return png_of(figure)


def _draw_ratings(plot: Any, table: TrainingTable) -> None:
    """Ratings of the frozen copies with their intervals; nothing without any."""
    plot.set_visible(bool(table.copies))
    for _, decisions, (rating, low, high) in ((*copy[:2], astuple(copy.rating)) for copy in table.copies):
        plot.errorbar(decisions / 1e6, rating, [[rating - low], [high - rating]], color="C0", marker=".")
    plot.set_title(RATING, fontsize="medium")


def _draw_wins(plot: Any, table: TrainingTable) -> None:
    """Share of wins against each rival, with Wilson's interval."""
    training = table.training
    millions = [point[1] / 1e6 for point in training.points]
    for rival in training.task.rivals:
        scores = [scores_at(training.task, point)[rival] for point in training.points]
        low, high = zip(*(score.interval for score in scores), strict=True)
        plot.plot(millions, [score.share for score in scores], label=f"against {rival}", marker=".")
        plot.fill_between(millions, low, high, alpha=0.2)
    plot.set_title(WINS, fontsize="medium")
    plot.set_ylim(-0.03, 1.03)
    plot.legend(loc="lower right")
